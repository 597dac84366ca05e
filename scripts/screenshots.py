"""Pictures of every page, tab and dialog of the window, found by walking it.

    viscorig demo --out out
    python scripts/screenshots.py out/NAME.h5 [--to out/pictures] [--docs]

A folder for each screen (1366 x 768; 2560 x 1440 at scale 2) and mode (light, dark), a PNG for each page, tab
and dialog. What is cut or overlaps is printed, and the exit status is 1. `--docs` also renews
the pictures of the guide in docs/.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from itertools import chain
from pathlib import Path
from unittest.mock import patch

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "helpers")]

from layout_faults import layout_faults, places, word
from openers import close_all, close_popups, dialogs, openers
from PIL import Image
from PySide6.QtCore import QSettings
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QWidget
from shiboken6 import isValid

from gui.actions import printing
from gui.actions.controller import AppController
from gui.background.task import BackgroundCommand, BackgroundTask
from gui.frame.settings import Settings
from gui.frame.window import Window
from gui.pages.run import RunPage
from gui.style.theme import Appearance
from instrument.simulated_case import case_file

SCREENS = {"1366x768": (1366, 768, "1"), "2560x1440-scale-2": (1280, 720, "2")}
"""Width and height as the window sees them, and pixels a point."""
MODES = ("light", "dark")
_LIGHT_IN_DOCS = ("run", "sweep", "hammer", "material", "diagnosis")
IN_DOCS = {("light", name): f"window-{name}.png" for name in _LIGHT_IN_DOCS} | {
    ("dark", "sweep"): "window-dark.png"
}
_COLOURS, _EXACT = 256, 64
"""Of a picture in docs/, and how many of them are the commonest as they are: grounds, lines, letters."""
PATIENCE_S = 600.0
_LEAVING = ("&Quit", "&Close session")
_LOOKS_S = 0.7
"""Without any work: then a page has computed and read what it shows."""


def main() -> int:
    """Take them all, each screen in a process of its own: the scale belongs to the process."""
    options = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    options.add_argument("session", type=Path)
    options.add_argument("--to", type=Path, default=Path("out/pictures"))
    options.add_argument("--docs", action="store_true", help="renew the pictures in docs/, too")
    options.add_argument("--screen", choices=SCREENS, help="only this one")
    given = options.parse_args()
    if given.screen is not None:
        return _take(given.session, given.to / given.screen, given.screen, docs=given.docs)
    failed = 0
    for screen, (_, _, scale) in SCREENS.items():
        command = [sys.executable, __file__, str(given.session), "--to", str(given.to), "--screen", screen]
        docs = ["--docs"] if given.docs and scale == "1" else []
        failed |= subprocess.run([*command, *docs], env=os.environ | {"QT_SCALE_FACTOR": scale}).returncode
    return failed


def _take(session: Path, folder: Path, screen: str, *, docs: bool) -> int:
    faults: list[str] = []
    with tempfile.TemporaryDirectory() as name:
        application = QApplication([sys.argv[0], "-platform", _platform(screen, Path(name))])
        QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, name)
        appearance = Appearance(application, "light")
        window = Window(appearance, Settings())
        window.resize(*SCREENS[screen][:2])
        window.show()
        _fill(window, session)
        for mode in MODES:
            appearance.choose(mode)
            for place in places(window):
                _rest(window)
                faults += _faults(f"{screen}, {mode}, {place}", window)
                _save(window, folder / mode / f"{place}.png")
                if docs and (mode, place) in IN_DOCS:
                    _keep_small(folder / mode / f"{place}.png", ROOT / "docs" / IN_DOCS[mode, place])
        opened = _dialogs(window)
        for mode in MODES:
            appearance.choose(mode)
            for place, dialog in opened.items():
                faults += _faults(f"{screen}, {mode}, {place}", dialog)
                _save(dialog, folder / mode / f"{place}.png")
        close_all()
        window.close()
    for fault in dict.fromkeys(faults):
        print(fault)
    return 1 if faults else 0


def _platform(screen: str, folder: Path) -> str:
    """A screen as large as it is said to be: dialogs are no wider than theirs."""
    if os.environ["QT_QPA_PLATFORM"] != "offscreen":
        return os.environ["QT_QPA_PLATFORM"]
    wide, high, scale = SCREENS[screen]
    one = {"name": screen, "x": 0, "y": 0, "width": wide * int(scale), "height": high * int(scale)}
    (folder / "screens.json").write_text(
        json.dumps({"screens": [one | {"logicalDpi": 96, "logicalBaseDpi": 96, "dpr": 1}]})
    )
    return f"offscreen:configfile={folder / 'screens.json'}"


def _faults(place: str, seen: QWidget) -> list[str]:
    return [f"{place}: {fault}" for fault in layout_faults(seen)]


def _dialogs(window: Window) -> dict[str, QWidget]:
    """One of each that an action or a button opens, all open; nothing is run or stopped by pressing them."""
    found: dict[str, QWidget] = {}
    window.show_page(window.pages[0].objectName())
    with _nothing_runs():
        for text, act in openers(window):
            if text in _LEAVING:
                continue
            before = dialogs()
            act()
            close_popups()
            for dialog in dialogs() - before:
                # Asked for again, the one before goes: the latest is the one there is.
                found[f"dialog-{word(dialog.windowTitle())}"] = dialog
    return {place: dialog for place, dialog in found.items() if isValid(dialog) and dialog.isVisible()}


@contextmanager
def _nothing_runs() -> Iterator[None]:
    """A button pressed to see what it opens does nothing else; a printer is taken for granted."""
    with ExitStack() as changed:
        for of in (BackgroundCommand, AppController):
            changed.enter_context(patch.object(of, "start", lambda *_, **__: None))
        changed.enter_context(patch.object(printing, "has_printer", lambda: True))
        yield


def _fill(window: Window, session: Path) -> None:
    """An experiment in the form, and the session."""
    run = window.pages[0]
    assert isinstance(run, RunPage)
    run.files.open(case_file("experiment.toml"))
    window.open(session)
    if not _wait(PATIENCE_S, lambda: run.files.drafts is not None and window.controller.recorded is not None):
        sys.exit(f"{session}: was not opened: {window.notice.text}")
    run.files.name.setText("experiment.toml")
    run.starting.out.setText("sessions")


def _wait(seconds: float, until: Callable[[], bool] = lambda: False) -> bool:
    end = time.monotonic() + seconds
    while time.monotonic() < end and not until():
        QApplication.processEvents()
        time.sleep(0.01)
    return until()


def _rest(window: Window) -> None:
    """Until nothing has been at work for a while."""
    last = time.monotonic()

    def rested() -> bool:
        nonlocal last
        works = (*window.findChildren(BackgroundTask), *window.findChildren(BackgroundCommand))
        drawn = all(getattr(pane, "drawn", True) for pane in window.findChildren(QWidget) if pane.isVisible())
        if not (drawn and all(work.over for work in works)):
            last = time.monotonic()
        return time.monotonic() - last > _LOOKS_S

    _wait(PATIENCE_S, rested)
    # On a machine that is behind, what was made last has yet to be laid out.
    _wait(_LOOKS_S)


def _save(seen: QWidget, path: Path) -> None:
    """As it is seen."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not seen.grab().toImage().convertToFormat(QImage.Format.Format_RGB888).save(str(path), "PNG", 0):
        sys.exit(f"{path}: cannot be written")
    print(f"{path}: {path.stat().st_size / 1e3:.0f} kB")


def _keep_small(path: Path, to: Path) -> None:
    """The picture in 256 colours, a third of its size: it stays in the repository."""
    picture = Image.open(path).convert("RGB")
    commonest = sorted(picture.getcolors(picture.width * picture.height), reverse=True)[:_EXACT]
    near = picture.quantize(_COLOURS - _EXACT, method=Image.Quantize.MAXCOVERAGE).getpalette()
    colours = Image.new("P", (1, 1))
    colours.putpalette([*chain.from_iterable(colour for _, colour in commonest), *near])
    picture.quantize(palette=colours, dither=Image.Dither.NONE).save(to, optimize=True)
    print(f"{to}: {to.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    sys.exit(main())
