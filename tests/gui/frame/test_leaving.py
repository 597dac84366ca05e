"""Closing the window while a run goes on: of what a person is asked, and what a yes does."""

import pytest
from PySide6.QtWidgets import QMessageBox, QPushButton
from session_cases import configuration

from drivers.shaker.modbus_driver import ModbusTcpOptions
from gui.feeds.live import LiveFeed
from gui.frame.leaving import leaving_question
from instrument.engine.messages import RigClosed, RigOpened

SHAKER = ModbusTcpOptions(address="127.0.0.1:1")


class Engine:
    """A run that goes on, says what it is made to and keeps what it is told."""

    running = True

    def __init__(self):
        self.says, self.told = [], []

    def poll(self, most=None):
        said, self.says = self.says, []
        return said

    def abort(self):
        self.told.append("abort")

    def stop(self):
        self.told.append("stop")

    def close(self):
        self.running = False


@pytest.fixture
def live(window, monkeypatch):
    feed = LiveFeed(None, configuration(), window.controller, Engine())
    monkeypatch.setattr(feed, "stop", feed.engine.stop)
    window.controller._show(feed)
    return feed


def hears(window, live, *messages):
    live.engine.says.extend(messages)
    window.turn()


def asked(window):
    (box,) = [box for box in window.findChildren(QMessageBox) if box.isVisible()]
    return box


def agree(window):
    next(b for b in asked(window).findChildren(QPushButton) if b.text() != "Cancel").click()


@pytest.mark.parametrize("said", [[], [RigOpened(SHAKER)], [RigOpened(SHAKER), RigClosed(at_rest=False)]])
def test_a_shaker_that_is_not_known_to_be_at_rest_is_asked_about_and_stopped(window, live, said):
    hears(window, live, *said)
    live.state.run.state = "diagnosing"
    window.close()
    assert asked(window).text().startswith("Stop the shaker, end the run and close?")
    agree(window)
    assert live.engine.told == ["stop"]


def test_of_a_run_that_only_computes_the_question_is_of_that_and_the_shaker_is_let_be(window, live):
    hears(window, live, RigOpened(SHAKER), RigClosed())
    live.state.run.state = "diagnosing"
    window.close()
    assert asked(window).text().startswith("The diagnosis goes on; the shaker is at rest. End it and close?")
    agree(window)
    assert live.engine.told == ["abort"]
    assert not window.notice.text
    live.engine.running = False
    window.turn()
    assert not window.isVisible()


def test_one_that_hangs_though_its_end_was_asked_for_is_stopped(qtbot, window, live, monkeypatch):
    monkeypatch.setattr("gui.frame.leaving.ENDS_S", 0.01)
    hears(window, live, RigOpened(SHAKER), RigClosed())
    window.close()
    agree(window)
    qtbot.waitUntil(lambda: live.engine.told == ["abort", "stop"])


def test_a_run_that_takes_the_shaker_again_is_asked_about_anew(window, live):
    hears(window, live, RigOpened(SHAKER), RigClosed())
    window.close()
    hears(window, live, RigOpened(SHAKER))
    assert asked(window).text() == leaving_question(window.controller).text
    assert asked(window).text().startswith("Stop the shaker")
    agree(window)
    assert live.engine.told == ["stop"]


def test_where_there_is_no_run_nothing_is_taken_for_at_rest(window):
    assert leaving_question(window.controller).yes == "Stop and close"
