"""Pictures of the window for the documentation.

    python scripts/screenshots.py SESSION.h5 [--to docs]

Writes one PNG a page, light, and one dark, as they are seen on a screen of 1366 x 768.
"""

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from PySide6.QtCore import QSettings
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication

from gui.background_task import BackgroundCommand, BackgroundTask
from gui.pages.run import RunPage
from gui.settings import Settings
from gui.theme import Appearance
from gui.window import Window
from instrument.simulated_case import case_file

WIDTH, HEIGHT = 1366, 768
PATIENCE_S = 600.0
_LOOKS_S = 1.0
"""Without any work: then a page has computed and read what it shows."""
_DARK = "sweep"


def main() -> int:
    """Take them all."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("session", type=Path)
    options.add_argument("--to", type=Path, default=Path("docs"))
    given = options.parse_args()
    application = QApplication([])
    with tempfile.TemporaryDirectory() as name:
        QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, name)
        appearance = Appearance(application, "light")
        window = Window(appearance, Settings())
        window.resize(WIDTH, HEIGHT)
        window.show()
        _fill(window, given.session)
        for page in window.pages:
            window.show_page(page.objectName())
            _rest(window)
            _save(window, given.to / f"window-{page.title.lower()}.png")
            if page.title.lower() == _DARK:
                appearance.choose("dark")
                _rest(window)
                _save(window, given.to / "window-dark.png")
                appearance.choose("light")
        window.close()
    return 0


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
        if not all(work.over for work in works):
            last = time.monotonic()
        return time.monotonic() - last > _LOOKS_S

    _wait(PATIENCE_S, rested)


def _save(window: Window, path: Path) -> None:
    """In few colours, which keeps it small."""
    image = window.grab().toImage().convertToFormat(QImage.Format.Format_Indexed8)
    if not image.save(str(path), "PNG", 0):  # type: ignore[call-overload]
        sys.exit(f"{path}: cannot be written")
    print(f"{path}: {path.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    sys.exit(main())
