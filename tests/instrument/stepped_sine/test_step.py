"""One step: from its command to its point."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from station import BASE_V, RANGE, RATE, Station, began, of_kind

from instrument.stepped_sine.calibration import Calibration
from instrument.stepped_sine.settings import Limits, Settle, SweepSettings
from instrument.stepped_sine.step import StepAnalysis
from instrument.stepped_sine.step_context import StepContext
from instrument.stream.derived import (
    DriveRequested,
    LimitExceeded,
    LimitWarned,
    LoopChecked,
    PointMeasured,
    RangeRequested,
    SettlingTimedOut,
    StepSettled,
)
from instrument.stream.scaling import Scaling

SCALING = Scaling({"base": 0, "velocity": 1}, {"base": 1 / BASE_V, "velocity": 1.0})
SETTINGS = SweepSettings()


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


def context_of(station, light=0.8):
    """A step that begins now, in a fine range without a calibration."""
    return StepContext(SETTINGS, SCALING, RATE, RANGE, station.now, signal_level=light)


def follow(
    station,
    step=None,
    settings=SETTINGS,
    *,
    wider=(),
    calibration=None,
    light=0.8,
    told=True,
    most=200,
    settled_at=None,
    range_is_new=False,
):
    """Do what the step asks for until it is done or gives up; every event."""
    step = step or began()
    ask = (lambda name: calibration) if calibration else None
    context = replace(
        context_of(station, light),
        settings=settings,
        wider=wider,
        calibration=ask,
        settled_at=settled_at,
        range_is_new=range_is_new,
    )
    analysis = StepAnalysis(step, context)
    analysis.commanded(station.command(step.frequency_hz, step.drive_v, told=told))
    events = []
    for _ in range(most):
        if analysis.done or of_kind(events, LimitExceeded) or of_kind(events, RangeRequested):
            break
        first, volts = station.read(analysis.wanted())
        overload = tuple(bool(v) for v in (np.abs(volts) > 10.0).any(axis=1))
        new = analysis.block(first, volts, overload)
        for request in of_kind(new, DriveRequested):
            analysis.commanded(station.command(step.frequency_hz, request.drive_v, told=told))
        events += new
    return events


def point_of(events):
    (point,) = of_kind(events, PointMeasured)
    return point


def test_a_steady_response_is_read_to_rounding():
    point = point_of(follow(Station(stirred=0.0, gain_m_s2_v=9.81 / 1.9)))
    assert point.velocity_m_s / point.base_m_s2 == pytest.approx(0.004 - 0.002j, rel=1e-9)
    assert abs(point.control_error_percent) < 1e-9
    assert point.remarks == ()


@pytest.mark.parametrize("free_hz", [5.0, 19.5, 20.0, 20.5, 26.7, 33.4, 60.0])
def test_a_transient_of_any_beat_is_waited_for(free_hz):
    """Also where the blocks are a whole number of beats apart, and drift hides at its smallest."""
    point = point_of(follow(Station(free_hz=free_hz, stirred=1.0, gain_m_s2_v=9.81 / 1.9)))
    assert abs(point.velocity_m_s / point.base_m_s2 / (0.004 - 0.002j) - 1) < SETTINGS.settle.tolerance
    assert point.remarks == ()


def test_settling_is_no_slower_than_waiting_for_the_whole_transient():
    point = point_of(follow(Station(stirred=0.3, gain_m_s2_v=9.81 / 1.9)))
    block_s = SETTINGS.block_s(20.0)
    whole_s = np.ceil(np.log(1000) / 8.0 / block_s) * block_s
    assert point.settle_s == pytest.approx(whole_s, rel=1e-3) or point.settle_s < whole_s


def test_what_may_be_left_of_a_transient_is_in_the_readings_error():
    truth = 0.004 - 0.002j
    patient, hasty = SETTINGS, replace(SETTINGS, settle=Settle(most_s=0.3))
    at_rest, moving = (
        point_of(follow(Station(stirred=1.0, gain_m_s2_v=9.81 / 1.9), settings=s)) for s in (patient, hasty)
    )
    assert "not settled" in moving.remarks[0]
    off = [abs(p.velocity_m_s / p.base_m_s2 - truth) * abs(p.base_m_s2) for p in (at_rest, moving)]
    assert off[0] < 3 * at_rest.velocity_std_m_s < 0.002 * abs(at_rest.velocity_m_s)
    assert off[1] < 3 * moving.velocity_std_m_s < abs(moving.velocity_m_s)
    assert moving.velocity_std_m_s > 20 * at_rest.velocity_std_m_s


def test_a_third_of_what_may_be_left_of_a_transient_is_a_standard_deviation():
    hasty = replace(SETTINGS, settle=Settle(tolerance=0.1))
    events = follow(Station(stirred=1.0, gain_m_s2_v=9.81 / 1.9), settings=hasty)
    (settled,) = of_kind(events, StepSettled)
    share = point_of(events).velocity_std_m_s / abs(point_of(events).velocity_m_s)
    assert share == pytest.approx(settled.remaining_percent / 100 / 3, rel=0.1)


def test_a_recorded_step_is_read_when_it_was_though_it_would_be_waited_for_now():
    """Later samples may not be there: an earlier version read sooner."""
    hasty = replace(SETTINGS, settle=Settle(0.1))
    rung = {"stirred": 1.0, "gain_m_s2_v": 9.81 / 1.9}
    earlier = follow(Station(**rung), settings=hasty)
    (settled,) = of_kind(earlier, StepSettled)
    again = point_of(follow(Station(**rung), settled_at=frozenset({settled.sample})))
    assert again.sample == point_of(earlier).sample < point_of(follow(Station(**rung))).sample
    assert again.velocity_std_m_s == pytest.approx(point_of(earlier).velocity_std_m_s)


def test_the_level_is_corrected_from_a_drive_that_is_far_off():
    events = follow(Station(gain_m_s2_v=20.0), began(drive_v=0.3))
    assert of_kind(events, DriveRequested)
    assert abs(point_of(events).control_error_percent) < 1.0


def test_a_level_within_tolerance_is_left_alone():
    assert not of_kind(follow(Station(gain_m_s2_v=9.81 / 1.9 * 1.003)), DriveRequested)


def test_a_level_more_than_half_its_tolerance_off_is_corrected():
    events = follow(Station(gain_m_s2_v=9.81 / 1.9 * 1.007))
    assert len(of_kind(events, DriveRequested)) == 1
    assert abs(point_of(events).control_error_percent) < 0.1


def test_without_an_echo_of_the_sample_the_latency_is_waited_out():
    point = point_of(follow(Station(stirred=1.0, gain_m_s2_v=9.81 / 1.9), told=False))
    assert abs(point.velocity_m_s / point.base_m_s2 / (0.004 - 0.002j) - 1) < SETTINGS.settle.tolerance


def test_noise_is_stated_as_it_scatters():
    settings = replace(SETTINGS, settle=Settle(tolerance=0.01))
    points = [
        point_of(
            follow(Station(noise_v=0.03, seed=k, stirred=0.0, gain_m_s2_v=9.81 / 1.9), settings=settings)
        )
        for k in range(60)
    ]
    velocity = np.array([p.velocity_m_s * abs(p.base_m_s2) / p.base_m_s2 for p in points])
    seen = float(np.sqrt((velocity.real.var() + velocity.imag.var()) / 2))
    stated = float(
        np.median(
            [
                np.hypot(p.velocity_std_m_s, abs(p.velocity_m_s / p.base_m_s2) * p.base_accel_std_m_s2)
                for p in points
            ]
        )
    )
    assert seen == pytest.approx(stated, rel=0.3)


def test_what_never_comes_to_rest_times_out_and_is_marked():
    settings = replace(SETTINGS, settle=Settle(most_s=1.0))
    events = follow(Station(decay_1_s=0.05, stirred=0.5, gain_m_s2_v=9.81 / 1.9), settings=settings)
    assert of_kind(events, SettlingTimedOut)
    assert "not settled" in point_of(events).remarks[0]


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


def test_a_drive_at_its_limit_is_marked_not_exceeded():
    events = follow(Station(gain_m_s2_v=1.4), began(drive_v=4.0))
    assert max(e.drive_v for e in of_kind(events, DriveRequested)) <= SETTINGS.limits.drive_v
    assert any("drive held at its limit" in r for r in point_of(events).remarks)
    assert point_of(events).drive_limited


def test_gain_and_delay_of_the_calibration_are_taken_off():
    exact = 0.004 - 0.002j
    seen = exact * 1.03 * np.exp(-2j * np.pi * 20.0 * 1.1e-3)
    station = Station(response_s=seen, stirred=0.0, gain_m_s2_v=9.81 / 1.9)
    point = point_of(follow(station, calibration=Calibration(1.03, 1.1e-3)))
    assert point.velocity_m_s / point.base_m_s2 == pytest.approx(exact, rel=1e-9)


def test_weak_light_is_marked():
    point = point_of(follow(Station(stirred=0.0, gain_m_s2_v=9.81 / 1.9), light=0.03))
    assert "weak light" in point.remarks[0]


def test_harmonics_are_told_from_the_response():
    class Distorted(Station):
        def read(self, samples, range_scale=RANGE.scale_m_s_v):
            first, x = super().read(samples)
            t = (first + np.arange(samples)) / RATE
            x[1] += 0.05 * abs(self.response_s) * 9.81 / range_scale * np.cos(2 * np.pi * 40.0 * t)
            return first, x

    point = point_of(follow(Distorted(stirred=0.0, gain_m_s2_v=9.81 / 1.9)))
    assert point.velocity_distortion_percent == pytest.approx(5.0, rel=1e-6)
    assert point.velocity_m_s / point.base_m_s2 == pytest.approx(0.004 - 0.002j, rel=1e-9)


def test_a_loop_check_measures_the_gain():
    step = began(level_m_s2=None, drive_v=0.1, purpose="loop-check")
    (found,) = of_kind(follow(Station(noise_v=1e-5), step), LoopChecked)
    assert found.gain_m_s2_v == pytest.approx(5.0, rel=1e-3)


def test_a_loop_check_without_an_answer_stops():
    step = began(level_m_s2=None, drive_v=0.1, purpose="loop-check")
    (stop,) = of_kind(follow(Station(gain_m_s2_v=0.0, noise_v=1e-5), step), LimitExceeded)
    assert "accelerometer connected" in stop.message


def test_blocks_cut_differently_give_the_same_point():
    whole = point_of(follow(Station(noise_v=1e-3, gain_m_s2_v=9.81 / 1.9)))

    class Crumbs(Station):
        def read(self, samples, range_scale=RANGE.scale_m_s_v):
            return super().read(min(samples, 97))

    crumbs = point_of(follow(Crumbs(gain_m_s2_v=9.81 / 1.9), most=10_000))
    assert crumbs.sample == whole.sample
    assert crumbs.settle_s == whole.settle_s


def test_a_settled_step_says_when_and_how_well():
    (settled,) = of_kind(follow(Station(gain_m_s2_v=9.81 / 1.9)), StepSettled)
    assert settled.remaining_percent <= 0.1
    assert 0 < settled.predicted_seconds < 2.0


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


@pytest.mark.parametrize("sample", [0, 10**15])
def test_a_receipt_that_counts_other_samples_is_taken_for_one_without(sample):
    station, step = Station(stirred=1.0, gain_m_s2_v=9.81 / 1.9), began()
    station.now = 5000
    analysis = StepAnalysis(step, context_of(station))
    command = station.command(step.frequency_hz, step.drive_v)
    analysis.commanded(replace(command, sample=sample))
    ramped_s = SETTINGS.latency_s + SETTINGS.control.ramp_s
    assert analysis.wanted() == pytest.approx((ramped_s + SETTINGS.block_s(20.0)) * RATE, abs=2)


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
