"""What the bar shows is of now, or says how old it is; and a recording says that it is one."""

from collections import deque
from time import monotonic

import httpx
import pytest
from engine_cases import LONG, drive_v, engine_rig
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from window_runs import run_until_driven

from gui.bars.gauge import Gauge
from gui.state.readings import FRESH_S

PATIENCE_MS = 60_000


class Looks:
    """The drive at the device and in the bar, many times a second."""

    def __init__(self, window, rig):
        self._gauge, self._rig = window.bar.gauges.drive, rig
        self._true: deque[tuple[float, float]] = deque()
        self.wrong: list[str] = []
        self.marked = self.count = 0

    def __call__(self):
        now, gauge = monotonic(), self._gauge
        self._true.append((now, drive_v(self._rig)))
        # One that was true for longer than this is remembered: what was shown was so within that time.
        while len(self._true) > 1 and now - self._true[1][0] > FRESH_S:
            self._true.popleft()
        self.count += 1
        self.marked += gauge.marked
        if gauge.value is None or gauge.marked or now - self._true[0][0] < FRESH_S:
            return
        low, high = min(v for _, v in self._true), max(v for _, v in self._true)
        if not low - 1e-3 <= gauge.value <= high + 1e-3:
            self.wrong.append(f"{gauge.value:.4g} V shown, {low:.4g} to {high:.4g} V at the device")


@pytest.fixture
def rig(tmp_path):
    with engine_rig(tmp_path, sweep=LONG, virtual=False) as (rig, experiment):
        slow = (tmp_path / "rig.toml").read_text().replace("[shaker]", "[shaker]\nheartbeat_timeout_s = 10.0")
        (tmp_path / "rig.toml").write_text(slow)
        yield rig, experiment


def look_on(qtbot, looks, until=None, seconds=None):
    """Until it is so, or for so long."""
    end = monotonic() + (seconds or PATIENCE_MS / 1e3)

    def so():
        looks()
        return until() if until is not None else monotonic() > end

    qtbot.waitUntil(so, timeout=PATIENCE_MS)


@pytest.mark.timing
def test_the_drive_shown_is_that_of_the_device_through_hold_hang_and_stop(qtbot, window, rig, tmp_path):
    rig, experiment = rig
    run_until_driven(qtbot, window, rig, experiment, tmp_path / "out")
    controller, looks = window.controller, Looks(window, rig)
    look_on(qtbot, looks, seconds=2.0)
    controller.commands.hold()
    look_on(qtbot, looks, lambda: controller.state.run.state == "held" and drive_v(rig) == 0)
    look_on(qtbot, looks, seconds=1.5)
    assert window.bar.gauges.drive.value == 0
    base = window.bar.gauges.by_name["base"]
    assert base.value is None or base.value < 0.1
    controller.commands.hold()
    look_on(qtbot, looks, lambda: drive_v(rig) > 0.05)
    look_on(qtbot, looks, seconds=1.0)
    httpx.put(f"{rig.front_end.url}/simulated/hang", trust_env=False).raise_for_status()
    look_on(qtbot, looks, seconds=1.5)
    assert base.marked
    assert "ago" in base.text()
    controller.commands.stop()
    look_on(qtbot, looks, lambda: not controller.running)
    assert looks.wrong == []
    assert looks.count > 50


def test_an_old_value_is_greyed_and_says_its_age(qtbot):
    gauge = Gauge("drive")
    qtbot.addWidget(gauge)
    gauge.resize(400, 20)
    gauge.show_value(1.04, 5.0, "V", 0.1)
    assert gauge.isEnabled()
    assert gauge.text() == "drive 1.04 / 5 V"
    gauge.show_value(1.04, 5.0, "V", 2.31)
    assert gauge.marked
    assert not gauge.isEnabled()
    assert gauge.text() == "drive 2.3 s ago: 1.04 V"


def test_a_recording_says_that_it_is_one(opened):
    assert "RECORDED" in opened.bar.state.text()
    live = opened.bar.grab().toImage().pixelColor(2, 2)
    opened.controller.leave()
    opened.turn()
    assert "RECORDED" not in opened.bar.state.text()
    assert opened.bar.grab().toImage().pixelColor(2, 2) != live


def test_nothing_is_shown_of_a_shaker_that_was_let_go_of(opened):
    state = opened.controller.state
    assert state.readings.drive_v is None
    assert opened.bar.gauges.drive.value is None


def test_a_click_on_the_scrubber_goes_there(qtbot, opened):
    feed, slider = opened.controller.recorded, opened.replay.slider
    at = slider.rect().center()
    at.setX(slider.width() // 4)
    QTest.mouseClick(slider, Qt.MouseButton.LeftButton, pos=at)
    qtbot.waitUntil(lambda: abs(feed.position_s / feed.length_s - 0.25) < 0.02)


def test_compare_lays_another_session_beside_this_one(qtbot, opened, monkeypatch, session_path):
    monkeypatch.setattr("gui.frame.window.ask_open_many", lambda *asked: asked[-1](session_path))
    material = next(p for p in opened.pages if p.title == "Material")
    read = []
    monkeypatch.setattr(material.comparison, "read", read.append)
    opened.replay.compare.click()
    assert read == [session_path]
    assert opened.tabs.currentWidget() is material


@pytest.mark.parametrize("large", [False, True])
def test_a_gauge_without_room_leaves_out_its_limit_and_never_cuts_a_unit_unseen(qtbot, large):
    gauge = Gauge("velocity", large=large)
    qtbot.addWidget(gauge)
    gauge.show()
    gauge.show_value(8.66, 1000.0, "mm/s")
    shown = []
    for width in range(600, 20, -1):
        gauge.resize(width, 20)
        said = gauge.text().removeprefix("<span style='font-size:large'>").removesuffix("</span>")
        if said not in shown:
            shown.append(said)
        assert gauge.sizeHint().width() <= width
    assert shown[:2] == ["velocity 8.66 / 1000 mm/s", "velocity 8.66 mm/s"]
    assert "\u202666 mm/s" in shown
    assert all(said.startswith("\u2026") for said in shown[2:])
    assert gauge.toolTip() == "velocity 8.66 / 1000 mm/s"
    gauge.resize(600, 20)
    assert (gauge.text() == shown[0]) is not large
    assert gauge.toolTip() == ""
