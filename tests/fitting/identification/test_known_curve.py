"""The covariance of a law's curve is that of laws drawn, and says what of it another measurement shares."""

import numpy as np
import pytest
from paper_law import TABLE_4

from fitting.identification.known_curve import known_curve, known_of_mixture
from fitting.laws.bent_law import BentLaw

ERRORS = np.array([0.03, 0.02, 0.04, 0.01])
LOW, HIGH = 14.0, 300.0


def curve(law, f):
    storage, eta = law.storage_and_loss(2 * np.pi * f)
    return np.concatenate([np.log(storage), eta])


def bent_law_known(bend_errors):
    """A law with two knots, its C as if data said as much of the bend as its prior does."""
    law = BentLaw(TABLE_4, (20.0, 200.0), (1.0,) * 4)
    return known_curve(law, np.diag(np.concatenate([1e-6 * np.ones(4), bend_errors]) ** 2), (), 20.0, 200.0)


def test_it_is_that_of_laws_drawn():
    f = np.array([20.0, 100.0, 250.0])
    known = known_curve(TABLE_4, np.diag((0.1 * ERRORS) ** 2), (), LOW, HIGH).at(f)
    rng = np.random.default_rng(5)
    drawn = [
        curve(TABLE_4.with_values(TABLE_4.values * np.exp(0.1 * ERRORS * rng.standard_normal(4))), f)
        for _ in range(2000)
    ]
    found, sizes = np.cov(np.array(drawn).T), np.sqrt(np.diag(known.covariance))
    assert np.sqrt(np.diag(found)) == pytest.approx(sizes, rel=0.08)
    assert np.abs((found - known.covariance) / np.outer(sizes, sizes)).max() < 0.12


def test_measured_again_a_law_scatters_by_what_the_data_say_alone():
    # Nothing is known but beforehand: both measurements say the same.
    untold = bent_law_known(np.ones(4))
    assert np.abs(untold.of_another_measurement).max() < 1e-6 * np.abs(untold.covariance).max()
    # The data say as much as what is known beforehand: C = 1/2, and estimates scatter by C F C = 1/4.
    half = bent_law_known(np.sqrt(0.5) * np.ones(4))
    np.testing.assert_allclose(half.of_another_measurement, 0.5 * half.covariance, rtol=1e-6, atol=1e-10)


def test_a_tolerance_passes_on_what_a_fit_beside_a_wrong_number_is_off_by():
    """Data that hold G' d^3 make of a d known to 2 % a modulus that is 6 % off the other way."""
    of_data = 1e3 * np.hstack([np.eye(4), np.array([[0.06, 0.06, 0, 0]]).T])
    J = np.vstack([of_data, [0, 0, 0, 0, 1]])
    known = known_curve(TABLE_4, np.linalg.inv(J.T @ J), ["core_thickness"], LOW, HIGH)
    n = len(known.frequency_hz)
    np.testing.assert_allclose(known.passed_on(["core_thickness"])[:n, 0], -0.06, rtol=1e-4)
    np.testing.assert_allclose(known.stated_part[:n], 0.06, rtol=1e-4)
    assert np.abs(known.by_stated[n:]).max() < 1e-9


def test_between_its_frequencies_it_is_what_it_is_there():
    known = known_curve(TABLE_4, np.diag(ERRORS**2), (), LOW, HIGH)
    f = np.sqrt(known.frequency_hz[1:] * known.frequency_hz[:-1])
    itself = known_curve(TABLE_4, np.diag(ERRORS**2), (), float(f[0]), float(f[-1]))
    there = known.at(itself.frequency_hz)
    np.testing.assert_allclose(np.diag(there.covariance), np.diag(itself.covariance), rtol=0.01)


def test_explanations_that_disagree_leave_the_curve_so_much_worse_known():
    known = known_curve(TABLE_4, np.diag(ERRORS**2), (), LOW, HIGH)
    rows = 2 * len(known.frequency_hz)
    shares = np.array([0.75, 0.25])
    apart = known_of_mixture([np.zeros(rows), np.ones(rows)], [known, known], shares)
    np.testing.assert_allclose(apart.covariance - known.covariance, 0.1875, rtol=1e-9)
    alike = known_of_mixture([np.ones(rows)] * 2, [known, known], shares)
    np.testing.assert_allclose(alike.covariance, known.covariance, rtol=1e-12)


@pytest.mark.parametrize("size", [np.nan, np.inf])
def test_without_errors_nothing_is_known(size):
    assert known_curve(TABLE_4, np.full((4, 4), size), (), LOW, HIGH) is None


def test_a_parameter_at_its_upper_limit_has_no_error_of_first_order():
    limit = TABLE_4.with_logs(TABLE_4.log_limits[1])
    assert np.abs(known_curve(limit, 0.01 * np.eye(4), (), LOW, HIGH).covariance).max() == 0.0
