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


def test_a_name_that_no_line_has_room_for_loses_its_middle_and_its_tool_tip_has_it(notice):
    notice.refuse(f"{PATH}: the file is empty")
    label = notice.findChild(QLabel)
    assert label.toolTip() == f"{PATH}: the file is empty"
    assert label.toolTip() == f"/measured/{notice.text}"
    path, _, why = label.text().partition(" ")
    assert why == "the file is empty"
    assert "\u2026" in path
    assert path.startswith("what")
    assert path.endswith(".csv:")
    assert label.fontMetrics().horizontalAdvance(path) <= label.width()


def test_a_file_is_called_by_its_name_and_the_tool_tip_has_its_path(notice):
    notice.refuse("/measured/a.csv: the file is empty")
    label = notice.findChild(QLabel)
    assert notice.text == label.text() == "a.csv: the file is empty"
    assert label.toolTip() == "/measured/a.csv: the file is empty"


def test_what_has_room_is_said_as_it_is(notice):
    notice.say("saved experiment.toml")
    label = notice.findChild(QLabel)
    assert (label.text(), label.toolTip()) == ("saved experiment.toml", "")
