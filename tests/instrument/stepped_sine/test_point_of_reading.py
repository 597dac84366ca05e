"""The point that a reading makes."""

from dataclasses import replace

import numpy as np
import pytest
from station import RANGE, RATE, began

from instrument.stepped_sine.calibration import Calibration
from instrument.stepped_sine.point_of_reading import Reading, point_of
from instrument.stepped_sine.settings import SweepSettings
from instrument.stepped_sine.sine_fit import SineFit
from instrument.stepped_sine.step_context import StepContext
from instrument.stream.scaling import Scaling

SCALING = Scaling({"base": 0, "velocity": 1}, {"base": 100.0, "velocity": 1.0})
CONTEXT = StepContext(SweepSettings(), SCALING, RATE, RANGE, 0, signal_level=0.8, temperature_c=21.5)
FIT = SineFit(
    np.array([[9.81, 0.0], [0.03 - 0.04j, 0.001j], [0.0, 0.0]]), np.array([0.01, 3e-4, 0.0]), np.zeros(3)
)
READING = Reading(
    first_sample=4096,
    dwell_s=0.5,
    settle_s=0.25,
    fit=FIT,
    left=0.0,
    level_m_s2=9.81,
    control_error=0.004,
    drive_v=1.9,
    range_name=RANGE.name,
    remarks=("not settled",),
)


def test_it_states_what_was_read():
    point = point_of(READING, began(), CONTEXT)
    assert point.velocity_m_s == 0.03 - 0.04j
    assert (point.base_m_s2, point.base_accel_std_m_s2) == (9.81, 0.01)
    assert point.velocity_std_m_s == 3e-4
    assert point.velocity_distortion_percent == pytest.approx(2.0)
    assert point.control_error_percent == pytest.approx(0.4)
    assert (point.sample, point.dwell_s, point.settle_s) == (4096, 0.5, 0.25)
    assert point.temperature_c == 21.5
    assert point.remarks == ("not settled",)


def test_a_third_of_what_may_be_left_of_a_transient_joins_the_noise():
    point = point_of(replace(READING, left=0.024), began(), CONTEXT)
    assert point.velocity_std_m_s == pytest.approx(np.hypot(3e-4, 0.008 * 0.05))


def test_a_calibration_scales_the_velocity_and_its_error():
    point = point_of(READING, began(), replace(CONTEXT, calibration=lambda name: Calibration(1.25, 0.0)))
    assert point.velocity_m_s == pytest.approx((0.03 - 0.04j) / 1.25)
    assert point.velocity_std_m_s == pytest.approx(3e-4 / 1.25)


def test_a_range_without_a_calibration_and_weak_light_are_said():
    point = point_of(READING, began(), replace(CONTEXT, calibration=lambda name: None, signal_level=0.01))
    assert point.remarks == (
        "not settled",
        f"range {RANGE.name} is not calibrated",
        "weak light: signal level 0.01",
    )


def test_a_velocity_within_its_noise_is_said():
    fit = replace(FIT, std=np.array([0.01, 0.02, 0.0]))
    assert (
        "velocity within its noise: 2.5 standard deviations"
        in point_of(replace(READING, fit=fit), began(), CONTEXT).remarks
    )
