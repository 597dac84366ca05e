"""What a fit knows where one of the law's numbers ran to zero."""

import numpy as np
import pytest

from fitting.diagnosis.inference.refitted import Refitted
from fitting.effects import CATALOGUE
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


def test_each_effect_has_its_unknowns_behind_the_stated_numbers_and_errors_where_they_are_fitted():
    law, spot = FractionalZener(1e5, 1e9, 1e-5, 0.5), CATALOGUE["spot_offset"]
    effects = (CATALOGUE["gain_error"], spot)
    free = np.array([True, True, *(not q.fixed for e in effects for q in e.parameters)])
    J = np.eye(20, 4 + free.sum())
    J[5, 5] = 4.0
    u = np.arange(float(len(free)))
    fitted = Refitted(effects, law, u, np.ones(10), np.ones(20), J, 20, free, 2, True)
    assert [(e.name, part) for e, part in fitted.each()] == [
        ("gain_error", slice(2, 3)),
        ("spot_offset", slice(3, 3 + len(spot.parameters))),
    ]
    assert fitted.of(spot).tolist() == u[3:].tolist()
    errors = fitted.unknown_errors()
    assert np.isnan(errors).tolist() == (~free).tolist()
    assert errors[1] == pytest.approx(errors[0] / 4)
    np.testing.assert_allclose(fitted.unknown_errors(4.0), 2 * errors)


def test_what_readings_say_less_sharply_is_no_doubt_about_what_is_stated():
    """A formula that may be wrong widens what comes from readings; a tolerance is as wide as it is stated."""
    law = FractionalZener(1e5, 1e9, 1e-5, 0.5)
    # Four numbers of the law that readings alone know, one stated number that they say nothing of.
    J = np.zeros((9, 5))
    J[:8, :4] = np.vstack([np.eye(4), np.eye(4)])
    J[8, 4] = 1.0
    fitted = Refitted((), law, np.zeros(1), np.ones(4), np.zeros(9), J, 8, np.ones(1, bool), 1, True)
    plain, wide = (np.sqrt(np.diag(fitted.tempered_covariance(t))) for t in (1.0, 100.0))
    np.testing.assert_array_equal(plain, np.sqrt(np.diag(fitted.covariance)))
    assert wide[4] == pytest.approx(1.0)
    assert plain[0] < wide[0] <= 10 * plain[0]
    assert fitted.unknown_errors(100.0)[0] == pytest.approx(1.0)
