"""The program around the window."""

import os
import signal
import sys
from functools import partial
from pathlib import Path

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from gui.frame.settings import Settings
from gui.frame.splash import splash
from gui.style.theme import Appearance
from instrument.errors import BadInput


def run(session: Path | None) -> int:
    """Show the window until it is closed; 0. Raises `BadInput` where there is no screen."""
    refuse_without_a_screen()
    application = QApplication(sys.argv[:1])
    application.setApplicationName("viscorig")
    settings = Settings()
    appearance = Appearance(application, settings.mode, settings.scale)
    first = splash()
    first.show()
    application.processEvents()
    # The window brings everything that computes along: most of a start is loading it.
    from gui.background.garbage import Collector
    from gui.frame.window import Window

    window = Window(appearance, settings)
    # Python sees a signal between two turns of the window's timer.
    signal.signal(signal.SIGINT, lambda *_: window.interrupt())
    collector = Collector(application)
    window.show()
    first.finish(window)
    if session is not None:
        QTimer.singleShot(0, window, partial(window.open, session))
    status = application.exec()
    collector.stop()
    return status


def refuse_without_a_screen() -> None:
    """Qt itself would end the program without a word to the user. Raises `BadInput`."""
    if not sys.platform.startswith("linux") or os.environ.get("QT_QPA_PLATFORM"):
        return
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise BadInput("no screen: DISPLAY and WAYLAND_DISPLAY are not set; run it on a desktop")
