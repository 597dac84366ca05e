"""The window with a run of its own: the engine's process, simulated instruments, real wires."""

import pytest
from engine_cases import engine_rig
from quick_engine import QUICK_ENGINE

from gui.feeds.live import LiveFeed
from instrument.engine import Engine, Order
from instrument.session.configuration import read_whole_experiment

pytestmark = pytest.mark.usefixtures("warm")

SWEEP = """
[[sweep.segments]]
low_hz = 95.0
high_hz = 107.0
points = 5
"""


@pytest.fixture
def rig(tmp_path):
    with engine_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        yield experiment


def start(window, experiment, out, parts=("sweep",)):
    """As `AppController.start`, with an engine that fits nothing."""
    order = Order(experiment, out, parts)
    configuration = read_whole_experiment(experiment).configuration("run", "")
    window.controller._show(
        LiveFeed(order, configuration, window.controller, Engine.start(order, QUICK_ENGINE))
    )
    return window.controller.live


def over(window):
    """Answers whatever is asked; whether the run is over."""
    if window.controller.live.question is not None:
        window.controller.live.answer()
    return not window.controller.running


def test_a_run_is_shown_to_its_end(qtbot, window, rig, tmp_path):
    live = start(window, rig, tmp_path / "out")
    assert window.controller.running
    qtbot.waitUntil(lambda: over(window))
    window.turn()
    assert live.ending.why == "done", live.ending
    assert len(live.state.contents.points) == 5
    assert live.state.run.state == "done"
    assert live.ending.session.is_file()
    assert not window.bar.stop.isEnabled()


def test_a_bad_experiment_is_refused_in_one_line(qtbot, window, tmp_path):
    bad = tmp_path / "bad.toml"
    bad.write_text("nonsense = 1")
    window.controller.start(Order(bad, tmp_path))
    qtbot.waitUntil(lambda: not window.controller.starting)
    assert "bad.toml" in window.notice.text
    assert window.controller.feed is None
