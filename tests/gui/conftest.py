"""The window without a screen, its settings in a folder of the test, and a small session."""

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import pytest
from PySide6.QtCore import QEvent, QSettings
from pytestqt.qtbot import QtBot
from session_cases import whole_session
from warm_commands import WarmProcess

from fitting.plugins import Registry
from gui.background import task
from gui.background.garbage import Collector
from gui.frame import page_set
from gui.frame.settings import Settings
from gui.frame.window import Window
from gui.pages import PAGES
from gui.style.theme import Appearance

PATIENCE_MS = 120_000
"""Of a wait that would fail the test: a machine with other work to do is slow, and shows nothing by it."""


class PatientBot(QtBot):
    """Waits longer than pytest-qt's five seconds, unless told how long."""

    def waitUntil(self, callback, *, timeout=PATIENCE_MS):
        super().waitUntil(callback, timeout=timeout)

    def waitSignal(self, signal, *, timeout=PATIENCE_MS, **options):
        return super().waitSignal(signal, timeout=timeout, **options)

    def waitExposed(self, widget, *, timeout=PATIENCE_MS):
        return super().waitExposed(widget, timeout=timeout)


@pytest.fixture
def qtbot(qapp, request):
    return PatientBot(request)


@pytest.fixture(scope="session")
def session_path(tmp_path_factory, cache_of_this_run):
    """Hammer test, calibration, three segments, a fit."""
    return whole_session(tmp_path_factory.mktemp("session"))


@pytest.fixture(autouse=True)
def rubbish_dies_in_the_main_thread(qapp):
    collector = Collector()
    yield
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    collector.stop()


@pytest.fixture(scope="module", autouse=True)
def warm_commands(forking):
    """The window's commands begin at once; with `cold` as a user's do."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(task, "QProcess", WarmProcess)
        yield


@pytest.fixture
def settings(tmp_path):
    QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(tmp_path / "settings"))
    return Settings()


@pytest.fixture
def appearance(qapp):
    # Dressed, a window takes twice as long to make; test_layout.py has it so.
    return Appearance(qapp, "light", dressed=False)


@pytest.fixture(scope="module", autouse=True)
def pages_there(request):
    """A module marked `pages` has windows with these alone: to make and draw all of them takes a second."""
    marker = request.node.get_closest_marker("pages")
    with pytest.MonkeyPatch.context() as patch:
        if marker is not None:
            named = {name: PAGES[name] for name in marker.args}
            patch.setattr(page_set, "PAGES", Registry("viscorig.pages", named, lambda name, found: found))
        yield


@pytest.fixture
def window(qtbot, appearance, settings):
    window = Window(appearance, settings)
    qtbot.addWidget(window, before_close_func=end_run)
    window.show()
    qtbot.waitExposed(window)
    return window


def end_run(window):
    """Of a test that failed in the middle of one: nobody is there to be asked."""
    if window.controller.live is not None:
        window.controller.live.engine.close()
        while window.controller.running:
            window.controller.live.advance()


@pytest.fixture(scope="module")
def window_of_the_module(qapp, pages_there, tmp_path_factory):
    settings = str(tmp_path_factory.mktemp("settings"))
    QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, settings)
    window = Window(Appearance(qapp, "light", dressed=False), Settings())
    yield window
    window.close()
    window.deleteLater()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)


@pytest.fixture
def kept_window(window_of_the_module):
    """One for the tests of a module that only look: with all its pages it takes a second to make."""
    window_of_the_module.show()
    yield window_of_the_module
    window_of_the_module.hide()


@pytest.fixture
def kept(qtbot, kept_window, session_path):
    """That window with the session in it, as the test before has left it."""
    if kept_window.controller.recorded is None:
        kept_window.open(session_path)
        qtbot.waitUntil(lambda: kept_window.controller.recorded is not None)
    return kept_window


@pytest.fixture
def opened(qtbot, window, session_path):
    """The window with the session in it, at its end."""
    window.open(session_path)
    qtbot.waitUntil(lambda: window.controller.recorded is not None)
    return window


@pytest.fixture
def made(qtbot, appearance):
    """A widget by itself, closed at the end of its test."""

    def make(widget):
        qtbot.addWidget(widget)
        return widget

    return make
