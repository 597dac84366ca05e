"""What is said of a mistake, by its kind and the factor that is left."""

from dataclasses import replace

import numpy as np
import pytest
import shear_pair_cases

from instrument.mistakes.response_mistakes import (
    Mistake,
    lacks_phase,
    mistakes,
    of_another_scale,
    response_of,
    words_of,
)

SWEEP = shear_pair_cases.sweep(shear_pair_cases.pair(0.573))
NONE = Mistake(response_of)


@pytest.mark.parametrize(
    ("factor", "drive", "said"),
    [
        (1e3, "base", "read in mm"),
        (1e3, "force", "or the force in kN"),
        (4.45, "force", "lbf"),
        (1 / 9.81, "base", "in g, or the reading is for 1 m/s^2"),
        (0.52, "base", "the base acceleration is peak to peak"),
        (0.52, "force", "the force is peak to peak"),
        (-1.0, "base", "the sign is turned"),
        (1j, "base", "turned by 90 degrees"),
        (np.exp(0.8j), "base", "turned by 46 degrees"),
        (17.0, "base", "17 times this specimen's"),
    ],
)
def test_a_factor_says_which_unit_it_is(factor, drive, said):
    assert said in words_of(NONE, factor, drive)


def test_no_factor_is_no_mistake():
    assert words_of(NONE, 1.05, "base") == ""


def test_slight_factors_are_those_of_a_calibration_and_some_of_them_habits():
    assert NONE.is_slight(1.3)
    assert not NONE.is_slight(-1.3)
    assert not NONE.is_slight(5.0)
    assert not Mistake(response_of, motion=1).is_slight(1.0)
    assert NONE.is_habit(0.7)
    assert not NONE.is_habit(1.15)


def test_every_mistake_can_be_taken_back_or_says_that_it_cannot():
    made = [m.taken_back(SWEEP) for m in (*mistakes(SWEEP), *of_another_scale())]
    assert any(one is None for one in made)
    assert all(one.shape == (len(SWEEP),) for one in made if one is not None)


def test_phasors_of_one_phase_lack_it():
    real = replace(SWEEP, velocity_m_s=np.abs(SWEEP.velocity_m_s) + 0j)
    assert lacks_phase(real)
    assert not lacks_phase(SWEEP)
