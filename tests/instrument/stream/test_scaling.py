"""Counts to volts to units: signs and ranges."""

import numpy as np
import pytest

from instrument.files.rig_file import Channels
from instrument.stream.scaling import Scaling, volts_of

COUNTS = np.array([[1, -2, 3], [4, 5, -6], [10, 20, 30]], dtype=np.int32)
PER_COUNT = (0.5, 0.25, 1e-3)


def sensors(**changes):
    """Acceleration at 10 mV, temperature at 10 mV a unit; the laser's own sensitivity means nothing."""
    return Channels.model_validate(
        {
            "base": {"input": 1, "sensitivity_mv_per_unit": 10.0},
            "velocity": {"input": 2, "sensitivity_mv_per_unit": 500.0},
            "temperature": {"input": 3, "sensitivity_mv_per_unit": 10.0},
            **changes,
        }
    ).named()


@pytest.fixture
def volts():
    return volts_of(COUNTS, PER_COUNT)


def test_volts_lie_row_by_row(volts):
    np.testing.assert_array_equal(volts, COUNTS * np.array(PER_COUNT)[:, None])
    assert volts.flags.c_contiguous


def test_a_velocity_takes_its_scale_from_the_range(volts):
    scaling = Scaling.of(("base", "velocity", "temperature"), sensors())
    np.testing.assert_array_equal(scaling.motion(volts, 0.02), [volts[0] * 100.0, volts[1] * 0.02])
    np.testing.assert_array_equal(scaling.units("temperature", volts), volts[2] * 100.0)


def test_a_sensor_that_faces_the_other_way_changes_sign(volts):
    turned = sensors(base={"input": 1, "invert": True}, velocity={"input": 2, "invert": True})
    scaling = Scaling.of(("velocity", "base"), turned)
    np.testing.assert_array_equal(scaling.motion(volts, 0.02), [-volts[1], -volts[0] * 0.02])
    assert not scaling.has("temperature")


def test_a_blow_is_force_and_response(volts):
    hammer = {"force": {"input": 4, "sensitivity_mv_per_unit": 2.0}, "response": {"input": 5}}
    scaling = Scaling.of(("force", "response"), sensors(**hammer))
    np.testing.assert_array_equal(scaling.blow(volts), [volts[0] * 500.0, volts[1]])
