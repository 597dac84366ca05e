"""A run in a window, begun by its buttons or past its forms, and waited for."""

from engine_cases import drive_v
from PySide6.QtCore import Qt
from quick_engine import QUICK_ENGINE

from gui.feeds.live import LiveFeed
from instrument.engine import Engine, Order
from instrument.session.configuration import read_whole_experiment

PATIENCE_MS = 120_000


def run_until_driven(qtbot, window, rig, experiment, out):
    order = Order(experiment, out, ("sweep",))
    configuration = read_whole_experiment(experiment).configuration("run", "")
    window.controller._show(
        LiveFeed(order, configuration, window.controller, Engine.start(order, QUICK_ENGINE))
    )
    live = window.controller.live
    qtbot.waitUntil(
        lambda: bool(live.state.contents.points) and live.stop_path is not None and drive_v(rig) > 0.05,
        timeout=60_000,
    )


def opened(qtbot, window, page, path):
    with qtbot.waitSignal(page.files.opened, timeout=PATIENCE_MS):
        window.open(path)
    return page


def started(qtbot, window, page):
    qtbot.mouseClick(page.starting.start, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: window.controller.running, timeout=PATIENCE_MS)
    return window.controller.live


def wait_for_points(qtbot, window, count=1):
    qtbot.waitUntil(lambda: len(window.controller.state.contents.points) >= count, timeout=PATIENCE_MS)


def wait_for_end(qtbot, window):
    """Of the run, until its recording is shown."""
    qtbot.waitUntil(lambda: not window.controller.running, timeout=PATIENCE_MS)
    qtbot.waitUntil(lambda: window.controller.recorded is not None, timeout=PATIENCE_MS)
    return window.controller.ending
