"""What a hammer test of the bare plate feels of the treated plate's stated numbers."""

import numpy as np
import pytest

from fitting.nuisances.bare_numbers import BareNumbers
from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.stated_coefficients import PlateCoefficients
from fitting.plate.parts import coefficients
from fitting.stated.tolerances import STATED

NAMES = ("core_thickness", "length", "substrate_young", "gain", "width", "constraining_density")


@pytest.fixture
def bare(zn1):
    each = tuple(Nuisance(n, n, STATED[n].typical) for n in NAMES)
    return BareNumbers(PlateCoefficients(each, zn1, zn1))


def test_it_feels_the_substrate_and_the_width_but_no_treatment_channel_or_mounting(bare):
    assert [NAMES[k] for k in bare.places] == ["substrate_young", "width"]


def test_its_stiffness_goes_with_the_substrate_s_modulus(bare, zn1):
    stated = coefficients(zn1.bare, zn1.bare)
    K_0, M = bare.coefficients(np.array([3.0, 2.0, 1.0, 0.0, 0.0, -1.0]))
    expected = np.exp(STATED["substrate_young"].typical) * stated.K_0
    np.testing.assert_allclose(K_0, expected, rtol=1e-12)
    np.testing.assert_array_equal(M, stated.M)
