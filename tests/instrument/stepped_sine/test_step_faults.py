"""One step whose channels, shaker or level are not as they should be: it asks for another range or stops."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from station import BASE_V, RANGE, RATE, Station, began, of_kind
from step_cases import SETTINGS, context_of, follow, point_of

from instrument.stepped_sine.settings import Limits
from instrument.stepped_sine.step import StepAnalysis
from instrument.stream.derived import (
    DriveRequested,
    LimitExceeded,
    LimitWarned,
    PointMeasured,
    RangeRequested,
)


@dataclass
class Still(Station):
    """A station whose velocity's input stands still for so many reads."""

    volts: float = 0.0
    blocks: int = 10**9

    def read(self, samples, range_scale=RANGE.scale_m_s_v):
        first, x = super().read(samples, range_scale)
        self.blocks -= 1
        if self.blocks >= 0:
            x[1] = self.volts
        return first, x


def test_an_overload_asks_for_the_next_coarser_range():
    station = Station(response_s=0.03, gain_m_s2_v=9.81 / 1.9)
    (request,) = of_kind(follow(station, wider=("50mm/s/V", "100mm/s/V")), RangeRequested)
    assert request.name == "50mm/s/V"


@pytest.mark.parametrize(("share", "clipped"), [(0.97, False), (0.99, True)])
def test_an_output_at_the_lasers_full_scale_is_an_overload_though_no_input_says_so(share, clipped):
    full_m_s = RANGE.full_scale_v * RANGE.scale_m_s_v
    station = Station(response_s=share * full_m_s / 9.81, stirred=0.0, gain_m_s2_v=9.81 / 1.9)
    events = follow(station, wider=("50mm/s/V",))
    assert [e.name for e in of_kind(events, RangeRequested)] == (["50mm/s/V"] if clipped else [])
    assert len(of_kind(events, PointMeasured)) == (not clipped)


def test_what_still_rings_beyond_a_range_just_set_is_waited_for():
    """A segment read finely after one that was read coarsely keeps its range; it asked for another before."""

    def rung(**how):
        return follow(Station(stirred=8.0, gain_m_s2_v=9.81 / 1.9), wider=("50mm/s/V",), **how)

    assert of_kind(rung(), RangeRequested)
    events = rung(range_is_new=True)
    assert not of_kind(events, RangeRequested)
    assert point_of(events).range_name == RANGE.name
    assert abs(point_of(events).velocity_m_s / point_of(events).base_m_s2 / (0.004 - 0.002j) - 1) < 1e-3


def test_what_does_not_ring_down_asks_for_a_coarser_range_all_the_same():
    station = Station(response_s=0.03, gain_m_s2_v=9.81 / 1.9)
    (request,) = of_kind(follow(station, wider=("50mm/s/V",), range_is_new=True), RangeRequested)
    assert request.name == "50mm/s/V"
    assert station.now / RATE < 4.0 / 8.0 + 1.0


def test_an_overload_of_the_coarsest_range_stops():
    (stop,) = of_kind(follow(Station(response_s=0.03, gain_m_s2_v=9.81 / 1.9)), LimitExceeded)
    assert "lower the level" in stop.message


def test_a_base_above_its_abort_band_stops():
    (stop,) = of_kind(follow(Station(gain_m_s2_v=20.0, response_s=0.001)), LimitExceeded)
    assert stop.what == "base acceleration over its level"
    assert stop.value == pytest.approx(38.0, rel=0.01)


@pytest.mark.parametrize(("peak_m_s2", "stops"), [(40.0, False), (70.0, True)])
def test_the_base_is_watched_on_the_way_to_a_new_drive(peak_m_s2, stops):
    """A frequency changes at once: before the ramp is over the base may have rung."""
    station, step = Station(gain_m_s2_v=9.81 / 1.9), began()
    analysis = StepAnalysis(step, context_of(station))
    analysis.commanded(station.command(step.frequency_hz, step.drive_v))
    first, volts = station.read(analysis.wanted())
    ringing = volts.copy()
    ringing[0, 10:20] += peak_m_s2 * BASE_V * np.resize([1.0, -1.0], 10)
    stopped = of_kind(analysis.block(first, ringing, (False, False)), LimitExceeded)
    assert [e.what for e in stopped] == (["base acceleration on the way"] if stops else [])


def test_travel_is_limited_and_warned_of():
    step = began(frequency_hz=5.0, drive_v=1.9)
    station = Station(gain_m_s2_v=9.81 / 1.9, stirred=0.0)
    warned = follow(station, step, replace(SETTINGS, limits=Limits(travel_m=0.0105)))
    assert [w.what for w in of_kind(warned, LimitWarned)] == ["travel of the base"]
    (stop,) = of_kind(
        follow(Station(), step, replace(SETTINGS, limits=Limits(travel_m=0.009))), LimitExceeded
    )
    assert (stop.unit, stop.limit) == ("mm", 9.0)


class Failing(Station):
    """Its base is what `fail` makes of it, in m/s^2, by the time in s."""

    def __init__(self, fail, **station):
        super().__init__(stirred=0.0, **{"gain_m_s2_v": 9.81 / 1.9, **station})
        self._fail = fail

    def read(self, samples, range_scale=RANGE.scale_m_s_v):
        first, x = super().read(samples)
        t = (first + np.arange(samples)) / RATE
        x[0] = self._fail(x[0] / BASE_V, t) * BASE_V
        return first, x


def test_a_base_that_is_lost_is_no_level_to_correct():
    """A cable that came off, an amplifier that fell silent: the drive is not raised to its limit for it."""
    events = follow(Failing(lambda y, t: np.where(t > 0.1, 1e-4 * y, y), noise_v=1e-7))
    assert not of_kind(events, DriveRequested)
    (stop,) = of_kind(events, LimitExceeded)
    assert stop.what.startswith("base acceleration lost")
    assert "cable" in stop.message


def test_half_the_base_at_once_is_lost_too():
    (stop,) = of_kind(follow(Failing(lambda y, t: 0.5 * y)), LimitExceeded)
    assert stop.what.startswith("base acceleration lost")


def test_a_base_that_builds_up_slowly_is_waited_for():
    events = follow(Failing(lambda y, t: y * (1 - np.exp(-4 * t))))
    assert not of_kind(events, LimitExceeded)
    assert abs(point_of(events).control_error_percent) < 1.0


@pytest.mark.parametrize(("off", "said"), [(2e-3, "stopped"), (5e-4, "marked"), (5e-5, "")])
def test_a_shaker_at_another_frequency_than_told_is_seen(off, said):
    base = lambda y, t: 9.81 * np.cos(2 * np.pi * 20.0 * (1 + off) * t)  # noqa: E731
    events = follow(Failing(base, noise_v=1e-6))
    if said == "stopped":
        (stop,) = of_kind(events, LimitExceeded)
        assert "clock" in stop.message
        assert stop.value == pytest.approx(100 * off, rel=0.05)
    else:
        assert any("frequency" in r for r in point_of(events).remarks) == (said == "marked")


def test_an_accelerometer_that_saturates_is_no_level():
    events = follow(Failing(lambda y, t: np.clip(y, -8.5, 8.5)))
    (stop,) = of_kind(events, LimitExceeded)
    assert "flat top" in stop.message


def test_a_laser_that_saturates_below_its_full_scale_is_read_in_the_next_range():
    class Flat(Station):
        def read(self, samples, range_scale=RANGE.scale_m_s_v):
            first, x = super().read(samples)
            x[1] = np.clip(x[1], -1.8, 1.8)
            return first, x

    station = Flat(stirred=0.0, gain_m_s2_v=9.81 / 1.9)
    (request,) = of_kind(follow(station, wider=("50mm/s/V",)), RangeRequested)
    assert request.name == "50mm/s/V"
    assert any("flat top" in r for r in point_of(follow(station)).remarks)


def test_strong_harmonics_are_marked():
    class Distorted(Station):
        def read(self, samples, range_scale=RANGE.scale_m_s_v):
            first, x = super().read(samples)
            t = (first + np.arange(samples)) / RATE
            x[0] += 0.08 * 9.81 * BASE_V * np.cos(2 * np.pi * 40.0 * t)
            return first, x

    (remark,) = point_of(follow(Distorted(stirred=0.0, gain_m_s2_v=9.81 / 1.9))).remarks
    assert remark == "base distorted: harmonics of 8 %"


@pytest.mark.parametrize(("purpose", "key"), [("calibration", "[sweep.calibration]"), ("step", "[sweep]")])
def test_a_level_far_out_of_reach_names_its_key_and_asks_for_the_sensitivity_first(purpose, key):
    events = follow(Station(gain_m_s2_v=0.6), began(drive_v=5.0, purpose=purpose))
    (stop,) = of_kind(events, LimitExceeded)
    said = stop.message
    assert f"under the 9.81 m/s^2 of {key} level_g, short by 6.81" in said
    assert "limit 4.905 m/s^2: is the accelerometer" in said
    assert said.index("sensitivity_mv_per_unit") < said.index("limits.drive_v")


@pytest.mark.parametrize("volts", [0.0, 0.0123])
def test_a_velocity_whose_input_stands_still_ends_the_run(volts):
    events = follow(Still(volts=volts))
    (stop,) = of_kind(events, LimitExceeded)
    assert "velocity lost" in stop.message
    assert not of_kind(events, PointMeasured)


def test_a_velocity_that_stood_still_for_two_blocks_is_measured_all_the_same():
    events = follow(Still(stirred=0.0, blocks=2))
    assert not of_kind(events, LimitExceeded)
    assert point_of(events).velocity_m_s / point_of(events).base_m_s2 == pytest.approx(0.004 - 0.002j)


def test_a_base_that_is_lost_with_the_velocity_is_what_is_told():
    (stop,) = of_kind(follow(Still(gain_m_s2_v=1e-6)), LimitExceeded)
    assert "base acceleration lost" in stop.message
