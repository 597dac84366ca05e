"""What is said of a calibration that no laser on the base gives."""

import pytest

from instrument.run.refused_calibration import refused
from instrument.stream.derived import CalibrationFound


def said_of(gain, gain_std=None):
    gain_std = 2e-3 * gain if gain_std is None else gain_std
    found = refused(CalibrationFound("10mm/s/V", gain, 1e-3, gain_std, 1e-6, 7), [])
    return [one.message for one in found]


def test_a_likely_gain_is_not_refused():
    assert said_of(0.9) == said_of(1.2, 0.05) == []


@pytest.mark.parametrize(("gain", "factor"), [(0.10006, "10"), (9.7, "10"), (0.001, "1000")])
def test_a_power_of_ten_points_to_a_sensitivity(gain, factor):
    (said,) = said_of(gain)
    assert (
        f"which should be 1, is {gain:.4g}, limit {0.7 if gain < 1 else 1.3}: a factor of {factor}: " in said
    )
    assert "sensitivity_mv_per_unit" in said


@pytest.mark.parametrize(("gain", "gain_std"), [(0.00724, 0.0042), (3.3e-6, 1.1e-6), (40.0, 0.1)])
def test_a_gain_of_next_to_nothing_points_to_inputs_exchanged(gain, gain_std):
    (said,) = said_of(gain, gain_std)
    assert "are two inputs exchanged" in said


def test_another_gain_asks_for_the_laser_and_the_sensitivities():
    (said,) = said_of(0.55)
    assert "is 0.55, limit 0.7: is the laser on the base beside the accelerometer?" in said
    (said,) = said_of(1.0, 0.08)
    assert "differs between frequencies by 8 %, limit 5 %" in said
