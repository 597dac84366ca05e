"""Maxwell series that begin where a law without a formula has got to."""

import numpy as np
import pytest

from fitting.effects.core_law import OtherCoreLawEffect
from fitting.effects.given import Points
from fitting.laws.bent_law import BentLaw
from fitting.laws.fractional_zener import FractionalZener
from fitting.laws.generalised_maxwell import GeneralisedMaxwell
from fitting.laws.prony import series_of
from fitting.laws.smooth import Smooth
from fitting.laws.vicinity import Vicinity

FREQUENCIES_HZ = np.geomspace(15.0, 250.0, 40)
WIDE = GeneralisedMaxwell(0.156e6, (0.183e6, 0.9e6, 4.26e6), (4.24e-2, 1.69e-3, 6.3e-5))
"""Its first and last times lie outside the band: what is seen of them is their flanks."""


def test_a_series_of_three_lies_beside_one_whose_times_are_outside_the_band():
    found = series_of(lambda w: WIDE.modulus(w), 15.0, 250.0, 3)
    assert len(found.g_pa) <= 3
    assert found.max_error < 0.03


def test_what_follows_a_curve_is_a_material_beside_it():
    (law,) = GeneralisedMaxwell.following(Vicinity(FREQUENCIES_HZ, WIDE.storage_and_loss))
    omega = 2 * np.pi * FREQUENCIES_HZ
    assert np.abs(law.modulus(omega) / WIDE.modulus(omega) - 1).max() < 0.03
    assert not law.objections()


@pytest.mark.parametrize("bends", [True, False])
def test_a_law_with_a_formula_follows_one_that_is_only_smooth_and_bends_where_the_stated_one_may(bends):
    found = Smooth.through(WIDE, np.geomspace(15.0, 250.0, 6))
    zener = FractionalZener(0.3e6, 5e6, 1e-3, 0.7)
    stated = BentLaw.over(zener, FREQUENCIES_HZ) if bends else zener
    (law,) = OtherCoreLawEffect().following(found, stated, points())
    assert isinstance(law.plain, GeneralisedMaxwell)
    assert (law.bend_count > 0) == bends


def points():
    n = len(FREQUENCIES_HZ)
    return Points(2 * np.pi * FREQUENCIES_HZ, np.ones(n), np.arange(float(n)), True, True, "relative")
