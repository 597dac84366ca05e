"""The message beside the tabs: all of it can be read."""

import pytest
from PySide6.QtWidgets import QLabel, QTabWidget

from gui.frame.notice import Notice

PATH = "/measured/" + "_".join(["what", "somebody", "knows"] * 20) + ".csv"


@pytest.fixture
def notice(made):
    tabs, notice = made(QTabWidget()), Notice()
    tabs.addTab(QLabel("a page"), "Run")
    notice.float_beside(tabs)
    tabs.resize(600, 300)
    tabs.show()
    return notice


def test_a_path_that_no_line_has_room_for_loses_its_middle_and_its_tool_tip_has_it(notice):
    notice.refuse(f"{PATH}: the file is empty")
    label = notice.findChild(QLabel)
    assert notice.text == label.toolTip() == f"{PATH}: the file is empty"
    path, _, why = label.text().partition(" ")
    assert why == "the file is empty"
    assert "\u2026" in path
    assert path.startswith("/measured/what")
    assert path.endswith(".csv:")
    assert label.fontMetrics().horizontalAdvance(path) <= label.width()


def test_what_has_room_is_said_as_it_is(notice):
    notice.say("saved experiment.toml")
    label = notice.findChild(QLabel)
    assert (label.text(), label.toolTip()) == ("saved experiment.toml", "")
