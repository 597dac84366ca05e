import numpy as np
import pytest

from fitting.dynamics.bare_modes import CarriedSensor
from instrument.hammer_test.expected import expected_modes_hz


def test_the_sensor_lowers_every_mode_it_moves_in(coarse):
    bare = expected_modes_hz(coarse, None, 600.0)
    loaded = expected_modes_hz(coarse, CarriedSensor(2e-3, 0.27, 0.17), 600.0)
    assert np.all(loaded <= bare * (1 + 1e-12))
    assert loaded[0] < 0.999 * bare[0]


def test_only_modes_of_the_band_are_given(coarse):
    f = expected_modes_hz(coarse, None, 150.0)
    assert len(f) == 3
    assert f[0] == pytest.approx(17.7, rel=0.01)
