"""One step: from its command to its point."""

from dataclasses import replace

import numpy as np
import pytest
from station import RANGE, RATE, Station, began, of_kind
from step_cases import SETTINGS, context_of, follow, point_of

from instrument.stepped_sine.calibration import Calibration
from instrument.stepped_sine.settings import Settle
from instrument.stepped_sine.step import StepAnalysis
from instrument.stream.derived import (
    DriveRequested,
    LimitExceeded,
    LoopChecked,
    SettlingTimedOut,
    StepSettled,
)


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


@pytest.mark.parametrize("sample", [0, 10**15])
def test_a_receipt_that_counts_other_samples_is_taken_for_one_without(sample):
    station, step = Station(stirred=1.0, gain_m_s2_v=9.81 / 1.9), began()
    station.now = 5000
    analysis = StepAnalysis(step, context_of(station))
    command = station.command(step.frequency_hz, step.drive_v)
    analysis.commanded(replace(command, sample=sample))
    ramped_s = SETTINGS.latency_s + SETTINGS.control.ramp_s
    assert analysis.wanted() == pytest.approx((ramped_s + SETTINGS.block_s(20.0)) * RATE, abs=2)
