"""Values of a law that no core has, and such as are hardly known, are asked about."""

import numpy as np
import pytest

from fitting.identification.law_remarks import CORE_PA, beyond_cores, gain_of_energy, hardly_known

F, ONE = np.array([10.0, 20.0, 40.0]), np.ones(3)


def test_a_law_that_gives_energy_is_asked_about():
    assert gain_of_energy(F, np.array([0.3, 0.1, 0.2])) == []
    (said,) = gain_of_energy(F, np.array([0.3, 0.1, -0.4]))
    assert said.startswith("the loss factor is negative (-0.4 at 40 Hz)")


def test_what_is_hardly_known_is_said_to_be_known_within_a_factor():
    assert hardly_known("G'", F, 1e6 * ONE, 1e5 * ONE) == []
    (said,) = hardly_known("G'", F, 1e6 * ONE, np.array([1e5, 7e5, np.nan]))
    assert said.startswith("G' is known within a factor of 2 only at 20 Hz")
    (said,) = hardly_known("the loss factor", F, 0.3 * ONE, 0.15 * ONE)
    assert said.startswith("the loss factor is known within a factor of 1.6 only at 10 Hz")


@pytest.mark.parametrize(("mpa", "asked"), [(0.005, True), (0.02, False), (150.0, False), (350.0, True)])
def test_a_modulus_that_no_core_has_is_asked_about_with_its_units(mpa, asked):
    assert (CORE_PA[0] <= 1e6 * mpa <= CORE_PA[1]) is not asked
    said = beyond_cores(1e6 * mpa * np.array([0.6, 1.0, 1.2]))
    assert bool(said) is asked
    if asked:
        assert said[0].startswith(f"G' is {0.6 * mpa:.3g} to {1.2 * mpa:.3g} MPa; cores have 0.01 to 200 MPa")
        assert "frequencies in Hz" in said[0]
