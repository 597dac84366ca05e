"""Steps that leave out the resonance they are laid around."""

from types import SimpleNamespace

import numpy as np
import pytest

from instrument.check.coarse_steps import coarse_remarks
from instrument.check.forecast import Forecast
from instrument.stepped_sine.plan import PlannedSegment

WIDTH_HZ = 2.0


def forecast(gain=1.0):
    """One resonance at 100 Hz, 2 Hz wide; `gain` says how much of it is seen."""
    one = Forecast(SimpleNamespace(), np.array([100.0]), np.array([np.pi * WIDTH_HZ]))

    def velocity(f, level):
        return level * np.abs(1 + 20 * gain * WIDTH_HZ / 2 / (WIDTH_HZ / 2 + 1j * (f - 100.0)))

    return SimpleNamespace(mode_hz=one.mode_hz, mode_decay_1_s=one.mode_decay_1_s, velocity_m_s=velocity)


def steps(*frequencies_hz):
    return PlannedSegment(2, 1, frequencies_hz, (9.81,) * len(frequencies_hz), "")


def test_two_steps_beside_a_resonance_do_not_see_it():
    (said,) = coarse_remarks(forecast(), steps(80.0, 140.0))
    assert said == (
        "segment 2: no step on the resonance expected at about 100 Hz, which is 2 Hz wide: the nearest steps "
        "are 80 and 140 Hz"
    )


@pytest.mark.parametrize(
    "frequencies_hz", [(98.0, 99.5, 101.0), (80.0, 100.4, 140.0), (110.0, 140.0), (100.0,)]
)
def test_dense_steps_one_on_it_or_another_segment_s_resonance_are_not_spoken_of(frequencies_hz):
    assert list(coarse_remarks(forecast(), steps(*frequencies_hz))) == []


def test_a_mode_that_the_base_does_not_stir_is_none():
    assert list(coarse_remarks(forecast(gain=0.0), steps(80.0, 140.0))) == []
