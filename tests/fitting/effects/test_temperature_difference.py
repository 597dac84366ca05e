"""A core that was at another temperature in one file."""

import numpy as np
import pytest
from shear_pair_cases import LAW

from fitting.effects import CATALOGUE
from fitting.effects.given import ModulusAt, Points
from fitting.effects.temperature_difference import TemperatureDifferenceEffect

EFFECT = TemperatureDifferenceEffect()
OMEGA = 2 * np.pi * np.geomspace(20, 400, 7)
POINTS = Points(OMEGA, np.ones(7), np.arange(7.0), True, True, "absolute")


def modulus(warmer_k):
    return EFFECT.modulus(ModulusAt(LAW, POINTS, None), POINTS, np.array([warmer_k]))


def test_a_warm_core_is_as_at_lower_frequencies():
    # log10 a_T = -9 * 2 / (120 + 2), Williams, Landel and Ferry.
    assert modulus(2.0) == pytest.approx(LAW.modulus(OMEGA * 10 ** (-18 / 122)))
    assert modulus(0.0) == pytest.approx(LAW.modulus(OMEGA))
    assert np.all(np.abs(modulus(-2.0)) > np.abs(modulus(0.0)))


def test_one_file_cannot_show_it():
    assert (
        CATALOGUE["temperature_difference"].objection(POINTS, None)
        == "it lies between files, and there is one"
    )


@pytest.mark.parametrize(("warmer", "word"), [(1.5, "warmer"), (-1.5, "colder")])
def test_it_says_which_way(warmer, word):
    assert EFFECT.story({"warmer": warmer}) == f"the core is 1.5 K {word}"
