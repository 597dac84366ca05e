"""One command at a time, its bar, and files that are written beside it."""

from pathlib import Path

import pytest
from data_folder import DATA
from PySide6.QtCore import Qt

from gui.background.one_command import OneCommand
from gui.background.task import BackgroundTask
from gui.background.writing import Writing
from gui.widgets.work_bar import WorkBar
from instrument.facts.modes import ModesResult

MODES = ["modes", str(DATA / "numbers" / "coarse.toml"), "--count", "1"]
MISSING = ["modes", "none.toml"]


@pytest.fixture
def one(qapp):
    one = OneCommand()
    yield one
    one.drop()


def test_of_two_commands_the_last_one_s_end_is_told(qtbot, one):
    found, refused = [], []
    one.done.connect(found.append)
    one.failed.connect(refused.append)
    one.start(MODES, ModesResult)
    one.start(MISSING, ModesResult)
    qtbot.waitUntil(lambda: not one.running)
    assert (found, refused) == ([], ["none.toml: No such file or directory"])
    assert one.said == ["viscorig: none.toml: No such file or directory"]


def test_nothing_runs_any_more_when_the_end_is_told(qtbot, one):
    then = []
    one.done.connect(lambda found: then.append((len(found.modes), one.running)))
    one.start(MODES, ModesResult)
    assert one.running
    qtbot.waitUntil(lambda: then == [(1, False)])


def test_of_a_command_dropped_nothing_is_told(qtbot, one):
    told = []
    one.done.connect(told.append)
    one.failed.connect(told.append)
    one.start(MISSING, ModesResult)
    one.drop()
    assert not one.running
    qtbot.wait(50)
    assert told == []


def test_a_bar_without_a_length_has_one_once_a_fraction_is_told(qtbot):
    working = WorkBar()
    qtbot.addWidget(working)
    working.begin("starting")
    assert (working.doing.text(), working.bar.maximum()) == ("starting", 0)
    working.tell("fitting", 0.256)
    assert (working.doing.text(), working.bar.maximum(), working.bar.value()) == ("fitting", 100, 26)
    with qtbot.waitSignal(working.cancel.clicked):
        qtbot.mouseClick(working.cancel, Qt.MouseButton.LeftButton)


def test_what_was_written_and_why_it_was_not_are_said_in_a_line(qtbot):
    writing = Writing()
    with qtbot.waitSignal(writing.done) as told:
        writing.write(BackgroundTask(lambda _: "one.json", writing))
    assert told.args == ["wrote one.json"]
    with qtbot.waitSignal(writing.failed) as told:
        writing.write(BackgroundTask(lambda _: Path("none/one.json").read_text(), writing))
    assert told.args == ["none/one.json: No such file or directory"]
