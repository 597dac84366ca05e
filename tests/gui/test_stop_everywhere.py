"""F12 and the red button, whatever is open."""

import random
import time
from functools import partial

import pytest
from engine_cases import LONG, drive_v, engine_rig, is_silent, wait_until
from openers import aside, click, close_all, dialogs, opened_by, openers, popups, press, visit
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDialog, QFileDialog, QLineEdit, QMessageBox
from window_runs import run_until_driven

from gui.actions.controller import AppController
from gui.actions.run_commands import RunCommands
from gui.background.task import BackgroundCommand

WITHIN_S = 0.5


@pytest.fixture
def stops(monkeypatch):
    """One for each stop asked for; nothing is stopped, no command is run."""
    asked = []
    monkeypatch.setattr(RunCommands, "stop", lambda commands: asked.append(time.monotonic()))
    monkeypatch.setattr(BackgroundCommand, "start", lambda command: None)
    return asked


@pytest.fixture
def busy(qtbot, stops, opened, tmp_path, monkeypatch):
    """A window with a session and an experiment, as if a run went on."""
    monkeypatch.chdir(tmp_path)
    with engine_rig(tmp_path, sweep=LONG) as (_, experiment):
        opened.open(experiment)
        qtbot.waitUntil(lambda: opened.pages[0].files.drafts is not None)
    with monkeypatch.context() as patched:
        patched.setattr(AppController, "running", property(lambda controller: True))
        opened.turn()
        yield opened
        close_all()


def stopped_from(window, dialog, stops) -> list[str]:
    """What does not stop while this is open."""
    found = []
    if QApplication.activeModalWidget() is not None:
        found.append("it is modal")
    for what, does in (
        ("F12", lambda: press(dialog, Qt.Key.Key_F12)),
        ("STOP", lambda: click(window.bar.stop)),
    ):
        before = len(stops)
        does()
        if len(stops) == before:
            found.append(what)
    return found


def test_every_dialog_there_is_leaves_the_stop_key_and_the_button_alive(qtbot, busy, stops, monkeypatch):
    monkeypatch.setattr("gui.actions.printing.has_printer", lambda: True)
    seen: dict[str, list[str]] = {}

    ours = []

    def walk(inside):
        for opener in openers(inside):
            visit(qtbot, opener, partial(look, opener))
            if busy.isFullScreen():
                # The screen of these tests is smaller than any that is used.
                busy.showNormal()

    def look(opener, dialog):
        name = f"{dialog.windowTitle()}: {dialog.text() if isinstance(dialog, QMessageBox) else ''}"
        if name not in seen:
            aside(busy, dialog)
            seen[name] = stopped_from(busy, dialog, stops)
            if not isinstance(dialog, QFileDialog | QMessageBox):
                ours.append(opener)

    walk(busy)
    for opener in list(ours):
        walk(opened_by(opener))
        close_all()
    assert len(seen) >= 10, sorted(seen)
    titles = " ".join(seen)
    for known in (
        "Keys",
        "Open",
        "A run goes on",
        "New experiment",
        "Export PNG",
        "Save report",
        "Print report",
        "Compare",
    ):
        assert known in titles
    assert {name: faults for name, faults in seen.items() if faults} == {}


def test_every_menu_and_list_leaves_the_stop_key_and_the_button_alive(qtbot, busy, stops):
    silent = {}
    for page in busy.pages:
        busy.show_page(page.objectName())
        for name, show in popups(busy):
            for what in ("F12", "STOP"):
                show()
                popup = QApplication.activePopupWidget()
                if popup is None or popup.geometry().intersects(
                    busy.bar.stop.rect().translated(busy.bar.stop.mapToGlobal(busy.bar.stop.rect().topLeft()))
                ):
                    close_all()
                    continue
                before = len(stops)
                press(popup, Qt.Key.Key_F12) if what == "F12" else click(busy.bar.stop)
                if len(stops) == before:
                    silent[name] = what
                close_all()
    assert silent == {}


def test_a_dialog_that_would_be_modal_is_not(qtbot, busy, stops):
    found = []
    made = QDialog(busy)

    def look(dialog):
        aside(busy, dialog)
        found.append(stopped_from(busy, dialog, stops))

    visit(qtbot, ("modal", made.exec), look)
    assert found == [[]]


def test_the_key_stops_while_somebody_types(qtbot, busy, stops):
    busy.show_page("run")
    field = next(f for f in busy.pages[0].findChildren(QLineEdit) if f.isVisible())
    field.setFocus()
    press(field, Qt.Key.Key_F12)
    assert len(stops) == 1


def test_the_key_is_heard_for_as_long_as_the_button_can_be_pressed(stops, window):
    for starting, running in ((False, False), (True, False), (False, True), (False, False)):
        with pytest.MonkeyPatch.context() as patched:
            patched.setattr(AppController, "starting", property(lambda controller, now=starting: now))
            patched.setattr(AppController, "running", property(lambda controller, now=running: now))
            window.turn()
            before = len(stops)
            press(window, Qt.Key.Key_F12)
            assert window.bar.stop.isEnabled() == (len(stops) > before) == (starting or running)


def test_escape_twice_stops_from_inside_a_dialog_too(qtbot, busy, stops):
    dialog = opened_by(next(o for o in openers(busy) if o[0] == "&Keys"))
    press(dialog, Qt.Key.Key_Escape)
    assert dialogs() == set()
    press(busy, Qt.Key.Key_Escape)
    assert len(stops) == 1


def test_a_file_dialog_gives_what_was_chosen(qtbot, opened, session_path):
    chosen = []
    opened.controller.experiment_chosen.connect(chosen.append)
    dialog = opened_by(next(o for o in openers(opened) if o[0] == "&Open..."))
    assert isinstance(dialog, QFileDialog)
    path = session_path.parent / "other.toml"
    path.write_text("")
    dialog.setDirectory(str(path.parent))
    dialog.selectFile(path.name)
    dialog.accept()
    assert chosen == [path]


def test_a_ctrl_c_on_the_terminal_asks_and_another_one_stops_the_run(busy, stops):
    busy.interrupt()
    (asked,) = dialogs()
    assert asked.objectName() == "A run goes on"
    assert not stops
    asked.button(QMessageBox.StandardButton.Cancel).click()
    # What was answered by a no is asked anew.
    busy.interrupt()
    assert not stops
    busy.interrupt()
    assert len(stops) == 1
    assert not dialogs()
    busy.interrupt()
    assert not dialogs()


# With a shaker


def opened_now(qtbot, window, name):
    """A dialog or a menu by its opener's name; the widget that has the keyboard."""
    if name == "menu":
        menu = next(m for m in window.menuBar().actions() if m.text() == "&View").menu()
        menu.popup(window.mapToGlobal(window.rect().center()))
        return menu
    if name == "form":
        return window
    if name == "closing":
        window.close()
        (dialog,) = dialogs()
    else:
        dialog = opened_by(next(o for o in openers(window) if o[0] == name))
    aside(window, dialog)
    return dialog


PLACES = ("&Keys", "&Open...", "closing", "menu", "form", "Export PNG...")


def stop_once(qtbot, window, folder, place, by_key, wait_s=0.0):
    """Seconds from the key or the click until the shaker is at zero."""
    folder.mkdir()
    with engine_rig(folder, sweep=LONG) as (rig, experiment):
        run_until_driven(qtbot, window, rig, experiment, folder / "out")
        on = opened_now(qtbot, window, place)
        qtbot.wait(round(1e3 * wait_s))
        began = time.monotonic()
        press(on, Qt.Key.Key_F12) if by_key else click(window.bar.stop)
        wait_until(lambda: QApplication.processEvents() or drive_v(rig) == 0, 10)
        took = time.monotonic() - began
        close_all()
        qtbot.waitUntil(lambda: not window.controller.running)
        assert is_silent(rig)
        assert window.controller.ending is None or window.controller.ending.why == "stopped by the user"
    return took


@pytest.mark.timing
@pytest.mark.parametrize(("place", "by_key"), [("&Keys", True), ("&Open...", False), ("closing", True)])
def test_the_shaker_is_silent_within_half_a_second(qtbot, window, tmp_path, place, by_key):
    assert stop_once(qtbot, window, tmp_path / "run", place, by_key) < WITHIN_S


@pytest.mark.long
@pytest.mark.timing
def test_the_shaker_is_silent_whatever_is_open_and_whenever(qtbot, window, tmp_path):
    chance, took = random.Random(15), []
    for number in range(60):
        place, by_key = PLACES[number % len(PLACES)], chance.random() < 0.5
        wait_s = chance.uniform(0.0, 1.0)
        took.append((stop_once(qtbot, window, tmp_path / str(number), place, by_key, wait_s), place, by_key))
    worst = max(took)
    print(f"worst of {len(took)}: {worst[0]:.3f} s ({worst[1]}, {'key' if worst[2] else 'mouse'})")
    assert worst[0] < WITHIN_S, sorted(took)[-5:]
