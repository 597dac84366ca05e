"""The window's small parts, each alone."""

from datetime import datetime, timedelta
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent, QShowEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialog, QLabel, QMainWindow, QPushButton, QWidget

from gui.actions.controller import AppController
from gui.bars.replay_bar import ReplayBar, Scrubber
from gui.bars.run_gauges import state_color
from gui.bars.stop_button import StopButton
from gui.bars.top_bar import TopBar, duration
from gui.feeds import feed
from gui.frame.log_pane import LogPane
from gui.frame.stop_guard import StopGuard
from gui.page import Page
from gui.state.log import Log
from gui.state.run import WORDS
from gui.style.style_sheet import PRIMARY, style_sheet
from gui.style.theme import DARK, LIGHT, Appearance, current_theme
from gui.widgets.basic import button, hint, tool
from gui.widgets.mark import Mark
from gui.widgets.tables import Cell, ReadTable

NO_KEY = Qt.KeyboardModifier.NoModifier


def test_a_line_in_a_colour_shows_signs_as_they_are(made):
    mark = made(Mark())
    mark.say("a < b", "bad")
    assert mark.said == "a < b"
    assert "a &lt; b" in mark.text()
    assert LIGHT.color("bad").name() in mark.text()
    mark.say("", "bad")
    assert mark.text() == ""


def test_larger_type_reaches_widgets_that_are_there_and_dressed(qtbot, qapp):
    appearance = Appearance(qapp, "light")
    whole = QWidget()
    qtbot.addWidget(whole)
    label, press = QLabel("a line", whole), QPushButton("Start", whole)
    whole.show()
    usual = [one.fontMetrics().height() for one in (label, press)]
    appearance.resize(1.5)
    larger = [one.fontMetrics().height() for one in (label, press)]
    appearance.resize(1.0)
    assert all(b > 1.3 * a for a, b in zip(usual, larger, strict=True))
    qapp.setStyleSheet("")


def test_larger_type_reaches_the_stop_button_and_the_title_of_the_log(qtbot, qapp):
    appearance = Appearance(qapp, "light")
    whole = QMainWindow()
    qtbot.addWidget(whole)
    stop, log = StopButton(), LogPane()
    whole.setCentralWidget(stop)
    whole.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, log)
    whole.show()

    def sizes():
        # Qt writes the title in the system's type where the pane's is the application's.
        assert log.font() != qapp.font()
        return stop.font().pointSizeF(), stop.minimumWidth(), log.font().pointSizeF()

    usual = sizes()
    appearance.resize(1.5)
    larger = sizes()
    appearance.resize(1.0)
    again = sizes()
    qapp.setStyleSheet("")
    assert all(b > 1.3 * a for a, b in zip(usual, larger, strict=True))
    assert again == usual


def test_looks_that_are_held_wait_and_are_shown_afterwards(qtbot, qapp):
    appearance = Appearance(qapp, "light", dressed=False)
    usual = qapp.font().pointSizeF()
    appearance.hold(True)
    appearance.choose("dark")
    appearance.resize(1.5)
    assert appearance.waiting
    assert (current_theme(), qapp.font().pointSizeF()) == (LIGHT, usual)
    appearance.hold(False)
    assert not appearance.waiting
    assert (current_theme(), qapp.font().pointSizeF()) == (DARK, 1.5 * usual)
    appearance.choose("light")
    appearance.resize(1.0)
    assert (current_theme(), qapp.font().pointSizeF()) == (LIGHT, usual)


def test_the_bar_has_room_for_every_state_of_a_recording(made, monkeypatch):
    controller = AppController()
    monkeypatch.setattr(AppController, "recorded", object())
    bar = made(TopBar(controller))
    for word in WORDS.values():
        bar._say("#000000", word, "what comes next")
        assert "RECORDED" in bar.state.text()
        assert bar.state.sizeHint().width() <= bar.state.width(), word


def test_what_takes_longer_than_foreseen_has_no_seconds_left(made, monkeypatch):
    controller = AppController()
    bar, state = made(TopBar(controller)), SimpleNamespace(run=SimpleNamespace(over=False))
    for left_s, said in ((45.0, "45 s left"), (1.0, "1 s left"), (0.2, "soon done"), (None, "")):
        controller.feed = SimpleNamespace(fraction=0.9, left_s=left_s)
        bar._show_progress(state)
        assert bar.left.text() == said
    controller.feed = None


def test_why_a_recording_was_not_verified_widens_nothing(made):
    bar = made(ReplayBar())
    before = bar.minimumSizeHint().width()
    bar._not_compared("/measured/" + 20 * "what_is_known_of_it_" + ".h5: no such file")
    assert bar.minimumSizeHint().width() < before + 50
    assert "no such file" in bar.verdict.toolTip()


def test_a_sign_without_words_has_them_for_whoever_cannot_see_it(made):
    assert made(tool("left", "The point before")).accessibleName() == "The point before"


def test_only_the_button_that_goes_on_is_dressed_as_such(made):
    assert made(button("Start", primary=True)).objectName() == PRIMARY
    assert made(button("Check", "Looks first")).objectName() == ""


def test_what_stands_where_nothing_is_yet_is_pale_and_not_cut(made):
    quiet = made(hint("Nothing yet"))
    assert quiet.wordWrap()
    assert not quiet.isEnabled()


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_every_colour_of_the_style_sheet_is_the_themes(theme):
    sheet = style_sheet(vars(theme))
    assert "$" not in sheet
    assert f"QPushButton#stop {{ background: {theme.stop}" in sheet


def test_the_stop_button_is_larger_than_the_windows_type(made):
    stop = made(StopButton())
    assert stop.font().pointSizeF() == pytest.approx(1.3 * made(QPushButton()).font().pointSizeF(), abs=0.5)
    assert stop.minimumWidth() >= 2 * stop.fontMetrics().horizontalAdvance("STOP")


def test_the_stop_key_is_taken_before_anybody_else_has_it(made):
    stopped = []
    guard = StopGuard(made(QPushButton()), lambda: stopped.append(1), lambda: None)
    other = made(QPushButton())
    for kind in (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress):
        assert guard.eventFilter(other, QKeyEvent(kind, Qt.Key.Key_F12, NO_KEY))
    assert stopped == [1]
    assert not guard.eventFilter(other, QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_F11, NO_KEY))


def test_no_dialog_holds_back_the_window_below_it(made):
    guard = StopGuard(made(QPushButton()), lambda: None, lambda: None)
    dialog = made(QDialog())
    dialog.setModal(True)
    assert not guard.eventFilter(dialog, QShowEvent())
    assert not dialog.isModal()


@pytest.mark.parametrize(
    ("seconds", "said"), [(-3.0, "0 s"), (59.4, "59 s"), (200.0, "3:20 min"), (3725.0, "1:02 h")]
)
def test_a_time_is_said_as_people_say_it(seconds, said):
    assert duration(seconds) == said


def test_what_a_row_does_not_say_of_a_column_stays_empty(made):
    table = made(ReadTable({"name": "", "value": "", "remark": ""}, selects=True, fills=False))
    table.show_rows([[Cell("a"), Cell("1", edge="good")], [], [Cell(text) for text in "xyz"]])
    assert table.texts(2) == ["", "", "z"]
    assert table.text.splitlines() == ["name\tvalue\tremark", "a\t1\t", "\t\t", "x\ty\tz"]
    # Measured and painted as any other.
    table.resizeColumnsToContents()
    table.grab()
    table.show_rows([[Cell("b")]], {"name": "", "value": "", "remark": "", "more": ""})
    assert table.cell(0, 3).text == ""


def test_a_stopped_run_has_the_colour_of_what_is_bad(appearance):
    assert state_color("stopped") == LIGHT.color("bad").name()
    assert state_color("held") == LIGHT.color("fair").name()
    assert state_color("sweep") == LIGHT.color("data").name()


def test_a_run_that_is_done_without_a_law_to_rely_on_is_not_green(appearance):
    assert state_color("done") == LIGHT.color("good").name()
    assert state_color("done", "effect") == LIGHT.color("good").name()
    assert state_color("done", "ambiguous") == LIGHT.color("fair").name()
    assert state_color("done", "unknown") == LIGHT.color("bad").name()
    assert state_color("diagnosing", "unknown") == LIGHT.color("data").name()


def test_a_click_beside_the_handle_goes_there(made):
    slider = made(Scrubber(Qt.Orientation.Horizontal))
    slider.setMaximum(1000)
    slider.resize(400, 20)
    slider.show()
    at = slider.rect().center()
    at.setX(300)
    QTest.mouseClick(slider, Qt.MouseButton.LeftButton, pos=at)
    assert slider.value() == pytest.approx(750, abs=30)


def test_the_log_is_written_on_and_its_oldest_lines_go_first(made, monkeypatch):
    monkeypatch.setattr("gui.state.log._MOST_LINES", 2)
    log, pane = Log(began=datetime(2026, 1, 1)), made(LogPane())
    state = SimpleNamespace(log=log)
    log.add(61.0, "first", "warning")
    pane.show_state(state)
    assert log.lines[0].wall == log.began + timedelta(seconds=61)
    assert pane.text.endswith("   1:01.0 ! first")
    for text in ("second", "third"):
        log.add(62.0, text)
        pane.show_state(state)
    assert ([line.text for line in log.lines], log.dropped) == (["second", "third"], 1)
    assert [line.split()[-1] for line in pane.text.splitlines()] == ["first", "second", "third"]
    pane.show_state(None)
    assert pane.text == ""


def test_with_less_room_the_newest_line_of_the_log_is_still_seen_unless_older_ones_are_looked_at(made, qtbot):
    log, pane = Log(began=datetime(2026, 1, 1)), made(LogPane())
    for number in range(30):
        log.add(number, f"line {number}")
    pane.resize(400, 300)
    pane.show()
    qtbot.waitExposed(pane)
    pane.show_state(SimpleNamespace(log=log))
    bar = pane.widget().verticalScrollBar()
    bar.setValue(bar.maximum())
    pane.resize(400, 120)
    qtbot.waitUntil(lambda: bar.maximum() > 20)
    assert bar.value() == bar.maximum()
    bar.setValue(3)
    pane.resize(400, 100)
    qtbot.wait(10)
    assert bar.value() == 3


def test_a_feeds_turn_ends_before_the_window_is_felt_to_wait(monkeypatch):
    clock = iter((10.0, 10.0 + 0.9 * feed.MOST_S, 10.0 + 1.1 * feed.MOST_S))
    monkeypatch.setattr(feed, "perf_counter", lambda: next(clock))
    turn = feed.Turn()
    assert [turn.over, turn.over] == [False, True]
    assert feed.Feed().ages_s == (0.0, 0.0)


def test_a_page_draws_only_what_is_new_and_only_while_it_is_seen(made):
    drawn = []

    class Counting(Page):
        def refresh(self, state):
            drawn.append((self.news("run"), self.news("points")))

        def clear(self):
            drawn.append("cleared")

    page, state = made(Counting(None)), SimpleNamespace(version=1, changed={"run": 1, "points": 1})
    page.show_state(state)
    assert drawn == []
    page.show()
    page.show_state(state)
    assert drawn == [(True, True)]
    state.version, state.changed["run"] = 2, 2
    page.show_state(state)
    page.redraw()
    assert drawn[1:] == [(True, False), (True, True)]
    page.show_state(None)
    page.show_state(None)
    assert drawn[3:] == ["cleared"]
