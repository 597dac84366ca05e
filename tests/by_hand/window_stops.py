"""Stops of a run in the window with every dialog, menu and editor there is open in turn, at random moments.

    python tests/by_hand/window_stops.py [--stops 200] [--seed 15]

What can be open is found by walking the window. Of each stop: what was open, mouse or key, and the seconds
until the simulated shaker is at zero; exit status 1 where one took over half a second. A longer form of
tests/gui/test_stop_everywhere.py.
"""

import argparse
import os
import random
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from engine_cases import LONG, drive_v, engine_rig, is_silent
from openers import aside, click, close_all, close_popups, dialogs, openers, popups, press
from PySide6.QtCore import QSettings, Qt, QTimer, qInstallMessageHandler
from PySide6.QtWidgets import QApplication, QComboBox, QLineEdit, QWidget
from window_runs import run_until_driven

from gui.actions.controller import AppController
from gui.background.garbage import Collector
from gui.background.task import BackgroundCommand
from gui.frame.settings import Settings
from gui.frame.window import Window
from gui.style.theme import Appearance
from instrument.simulated_case import write_case

WITHIN_S = 0.5
PATIENCE_S = 60.0
LATEST_S = 1.0
Place = tuple[str, Callable[[], QWidget | None]]
"""What is open, and what opens it: the widget that has the keyboard then, None where nothing came."""
_LEAVING = ("&Quit", "&Close session")


class Bot:
    """What `run_until_driven` asks of a test's."""

    def waitUntil(self, until: Callable[[], bool], timeout: float = 1e3 * PATIENCE_S) -> None:
        turn(until, timeout / 1e3)


def turn(until: Callable[[], bool], seconds: float) -> None:
    """Let the window live. Raises `TimeoutError`."""
    end = time.monotonic() + seconds
    while not until():
        if time.monotonic() > end:
            raise TimeoutError
        QApplication.processEvents()
        time.sleep(0.001)


@contextmanager
def nothing_runs() -> Iterator[None]:
    """A button pressed to see what it opens does nothing else."""
    kept = {of: of.start for of in (BackgroundCommand, AppController)}
    for of in kept:
        of.start = lambda *_, **__: None
    # Buttons that are not enabled now are pressed too, and need not know what to do.
    sys.excepthook = lambda *_: None
    # A button with a menu waits in it.
    watch = QTimer()
    watch.timeout.connect(close_popups)
    watch.start(20)
    try:
        yield
    finally:
        watch.stop()
        sys.excepthook = sys.__excepthook__
        for of, does in kept.items():
            of.start = does


def places_of(window: Window) -> list[Place]:
    """Everything that can be open, found by opening it."""
    found: dict[str, Place] = {"the window": ("the window", lambda: window)}
    with nothing_runs():
        for name, act in openers(window):
            before = dialogs()
            if name not in _LEAVING:
                act()
                close_popups()
            for dialog in dialogs() - before:
                title = dialog.windowTitle()
                found[f"dialog {title}"] = (f"dialog {title}", lambda act=act: _dialog(window, act))
            close_all()
    found["dialog closing"] = "dialog closing", lambda: _dialog(window, window.close)
    for page in window.pages:
        window.show_page(page.objectName())
        name = page.objectName()
        for title, show in popups(window):
            found[f"{name}, list {title}"] = f"{name}, list {title}", lambda show=show: _popup(window, show)
        for k, editor in enumerate(_editors(page)):
            key = f"{name}, editor {editor.accessibleName() or k}"
            found[key] = key, lambda name=name, editor=editor: _editor(window, name, editor)
    return list(found.values())


def _editors(page: QWidget) -> list[QWidget]:
    return [e for kind in (QLineEdit, QComboBox) for e in page.findChildren(kind) if e.isVisible()]


def _dialog(window: Window, act: Callable[[], object]) -> QWidget | None:
    before = dialogs()
    act()
    new = dialogs() - before
    for dialog in new:
        aside(window, dialog)
    return next(iter(new), None)


def _popup(window: Window, show: Callable[[], object]) -> QWidget | None:
    show()
    popup = QApplication.activePopupWidget()
    stop = window.bar.stop
    if popup is None or popup.geometry().intersects(
        stop.rect().translated(stop.mapToGlobal(stop.pos()) - stop.pos())
    ):
        close_popups()
        return None
    return popup


def _editor(window: Window, name: str, editor: QWidget) -> QWidget:
    window.show_page(name)
    editor.setFocus()
    return editor


def stop_once(window: Window, folder: Path, place: Place, by_key: bool, wait_s: float) -> float | None:
    """Seconds from the key or the click until the shaker is at zero; None where nothing could be opened."""
    folder.mkdir()
    with engine_rig(folder, sweep=LONG) as (rig, experiment):
        run_until_driven(Bot(), window, rig, experiment, folder / "out")
        on = place[1]()
        end = time.monotonic() + wait_s
        turn(lambda: time.monotonic() > end, PATIENCE_S)
        began = time.monotonic()
        if on is None:
            window.controller.commands.stop()
        elif by_key:
            press(on, Qt.Key.Key_F12)
        else:
            click(window.bar.stop)
        turn(lambda: drive_v(rig) == 0, 10.0)
        took = time.monotonic() - began
        close_all()
        turn(lambda: not window.controller.running, PATIENCE_S)
        if not is_silent(rig):
            raise RuntimeError(f"driven again after the stop with {place[0]} open")
    return took if on is not None else None


def main() -> int:
    """The worst of them, and how many took too long."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--stops", type=int, default=200)
    parser.add_argument("--seed", type=int, default=15)
    given = parser.parse_args()
    chance = random.Random(given.seed)
    qInstallMessageHandler(lambda *_: None)
    application = QApplication([])
    collector = Collector(application)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.chdir(folder)
        QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(folder / "settings"))
        window = Window(Appearance(application, "light"), Settings())
        window.resize(1366, 768)
        window.show()
        window.open(write_case(folder))
        turn(lambda: window.pages[0].files.drafts is not None, PATIENCE_S)
        places = places_of(window)
        print(f"{len(places)} places", flush=True)
        took, skipped = _all(window, folder, places, given.stops, chance)
        window.close()
    collector.stop()
    worst = sorted(took, reverse=True)[:5]
    late = [one for one in took if one[0] > WITHIN_S]
    print(f"{len(took)} stops, {len(places)} places, {len(skipped)} could not be opened: {sorted(skipped)}")
    print(*(f"{s:.3f} s, {what}, {how}" for s, what, how in worst), sep="\n")
    print(f"{len(late)} of {len(took)} over {WITHIN_S} s")
    return 1 if late else 0


def _all(
    window: Window, folder: Path, places: list[Place], stops: int, chance: random.Random
) -> tuple[list[tuple[float, str, str]], set[str]]:
    took: list[tuple[float, str, str]] = []
    skipped: set[str] = set()
    number = 0
    while len(took) < stops:
        chance.shuffle(places)
        for place in places[: stops - len(took)]:
            number += 1
            by_key = chance.random() < 0.5
            seconds = stop_once(window, folder / str(number), place, by_key, chance.uniform(0.0, LATEST_S))
            if seconds is None:
                skipped.add(place[0])
                continue
            took.append((seconds, place[0], "key" if by_key else "mouse"))
            print(f"{len(took)}: {seconds:.3f} s, {place[0]}, {took[-1][2]}", flush=True)
    return took, skipped


if __name__ == "__main__":
    sys.exit(main())
