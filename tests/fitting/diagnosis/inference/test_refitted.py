"""What a fit knows where one of the law's numbers ran to zero."""

import numpy as np
import pytest

from fitting.diagnosis.inference.refitted import Refitted
from fitting.laws.fractional_zener import FractionalZener

OMEGA = 2 * np.pi * np.geomspace(20, 2000, 12)
SIGMA = 0.02
LOW = np.array([2 * np.pi * 0.5])


def ended(g0_pa):
    """A fit to G* itself, known to 2 % over two decades, that ended at a modulus at rest."""
    law = FractionalZener(g0_pa, 1e9, 1e-5, 0.5)
    G = law.modulus(OMEGA)
    by = law.jacobian(OMEGA) * law.values[:, None] / (SIGMA * np.abs(G))
    J = np.concatenate([by.real, by.imag], axis=1).T
    none = np.empty(0)
    return Refitted((), law, none, G, np.ones(len(J)), J, len(J), none.astype(bool), 0, True)


def error_of_storage_pa(fitted, omega):
    by = (fitted.law.jacobian(omega) * fitted.law.values[:, None]).real[:, 0]
    return float(np.sqrt(by @ fitted.covariance @ by))


@pytest.mark.parametrize("g0_pa", [100.0, 101.0, 313.0, 3e3])
def test_a_modulus_at_rest_that_ran_to_zero_is_as_open_as_a_small_one(g0_pa):
    """Its logarithm says nothing there; as a number it is as well known as another one near zero."""
    small = error_of_storage_pa(ended(9e3), LOW)
    assert error_of_storage_pa(ended(g0_pa), LOW) == pytest.approx(small, rel=0.05)
    # Where the data are nothing changes.
    assert error_of_storage_pa(ended(g0_pa), OMEGA[6:7]) == pytest.approx(
        error_of_storage_pa(ended(9e3), OMEGA[6:7]), rel=0.05
    )


def test_what_sits_at_an_upper_limit_is_taken_as_fixed_there():
    law = FractionalZener(1e5, 1e9, 1e-5, 1.0)
    J = np.ones((8, 4)) + np.eye(8, 4)
    none = np.empty(0)
    fitted = Refitted((), law, none, np.ones(4), np.ones(8), J, 8, none.astype(bool), 0, True)
    assert fitted.covariance[3].tolist() == [0.0] * 4
    assert np.all(np.diag(fitted.covariance)[:3] > 0)
