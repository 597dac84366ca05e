"""A run in a window, begun past its forms."""

from engine_cases import drive_v
from quick_engine import QUICK_ENGINE

from gui.feeds.live import LiveFeed
from instrument.engine import Engine, Order
from instrument.session.configuration import read_whole_experiment


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
