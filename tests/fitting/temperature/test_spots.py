"""Spots of a fit over temperatures: how far from their places, how far from each other."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.nuisances.nuisance import Nuisance
from fitting.temperature.spots import spots_apart_m, spots_moved

SIGMA_M = 3e-4
EACH = (
    Nuisance("length", "length", SIGMA_M),
    *(Nuisance(f"pickup_{axis} [{k}]", "pickup", SIGMA_M) for k in (1, 2, 3) for axis in "xy"),
)
APART = SimpleNamespace(each=EACH, places=[np.array([0, 1 + 2 * k, 2 + 2 * k]) for k in range(3)])
Z = np.array([9.0, 1.0, 0.0, -2.0, 4.0, 0.5, 0.0])


def test_only_spots_are_counted_and_the_two_furthest_apart_are_said():
    np.testing.assert_array_equal(spots_moved(APART, Z), Z[1:])
    assert spots_apart_m(APART, Z) == pytest.approx(SIGMA_M * 5)


def test_one_spot_of_all_is_nowhere_else():
    one = SimpleNamespace(each=EACH[:3], places=[np.arange(3)] * 2)
    assert spots_apart_m(one, Z[:3]) == 0.0
    assert spots_apart_m(SimpleNamespace(each=EACH[:1], places=[np.arange(1)]), Z[:1]) == 0.0
