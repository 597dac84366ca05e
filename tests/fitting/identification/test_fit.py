"""What a fit hands on, and what its uncertainty is made of where parts of it are left out."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.data.noise import noise_of
from fitting.identification.doubt import doubts_among
from fitting.identification.fit import Fit
from fitting.identification.result import summarise
from fitting.identification.uncertainty import uncertainty_of
from fitting.identification.validation import Validation
from fitting.laws.bent_law import BentLaw
from fitting.laws.constant import ConstantModulus
from fitting.sweep import Sweep

LAW = ConstantModulus(1e6, 0.5)
J = np.array([[2.0, 0.0], [0.0, 4.0], [0.0, 0.0], [0.0, 0.0]])
FIT = Fit(LAW, np.array([0.0, 0.0, 3.0, 1.0]), J, np.ones(2, complex), 3, 5, converged=True)


def test_all_residuals_are_readings_unless_a_fit_says_how_many():
    # Ten over two degrees of freedom; of the first three readings nine over one.
    assert uncertainty_of(FIT, noise_is_known=True).chi2_per_dof == pytest.approx(5.0)
    assert uncertainty_of(replace(FIT, readings=3), noise_is_known=True).chi2_per_dof == pytest.approx(9.0)


def test_errors_come_of_the_jacobian_unless_a_covariance_is_given():
    of_J = uncertainty_of(FIT, noise_is_known=True).standard_errors
    assert of_J == pytest.approx(np.sqrt(5) * np.array([1 / 2, 1 / 4]))
    given = np.array([[0.04, 0.01], [0.01, 0.09]])
    found = uncertainty_of(replace(FIT, covariance=given), noise_is_known=True)
    np.testing.assert_array_equal(found.covariance, given)


def test_a_known_noise_is_not_made_smaller_by_a_good_fit():
    good = replace(FIT, residuals=FIT.residuals / 10)
    assert uncertainty_of(good, noise_is_known=True).standard_errors == pytest.approx([0.5, 0.25])
    smaller = np.sqrt(0.05) * np.array([0.5, 0.25])
    assert uncertainty_of(good, noise_is_known=False).standard_errors == pytest.approx(smaller)


def test_weights_choose_among_points_and_change_nothing_of_what_noise_is():
    w = np.array([1.0, 2.0, 1.0, 0.5])
    weighted = replace(FIT, residuals=w * FIT.residuals, jacobian=w[:, None] * J, weights=w)
    found, plain = (uncertainty_of(f, noise_is_known=True) for f in (weighted, FIT))
    assert found.chi2_per_dof == pytest.approx(plain.chi2_per_dof)
    assert found.standard_errors == pytest.approx(plain.standard_errors)


def test_as_many_parameters_as_readings_leave_nothing_to_judge_by():
    found = uncertainty_of(replace(FIT, readings=2), noise_is_known=True)
    assert np.isnan(found.chi2_per_dof)
    assert np.isnan(found.standard_errors).all()


def test_bends_at_their_limits_are_one_line_after_what_matters_more():
    v = 0.1 * np.exp(1j * np.arange(20.0))
    one = np.ones(20, dtype=np.intp)
    sweep = Sweep(np.linspace(10, 300, 20), v, np.full(20, 9.81), one, one, std_m_s=np.full(20, 1e-4))
    bent = BentLaw.over(LAW, sweep.frequency_hz)
    count, knots = len(bent.names), len(bent.knots_hz)
    bends = np.full(bent.bend_count, np.exp(8.0))
    bends[1] = bends[knots + 1] = 1.0
    law = bent.with_values(np.concatenate([LAW.values, bends]))
    fit = Fit(law, np.full(40, 3.0), np.eye(40, count), 2 * v, 5, 6, converged=True)
    said = summarise("direct", sweep, noise_of(sweep), fit, Validation()).warnings
    (bent_said,) = [one for one in said if "bend" in one]
    assert bent_said.startswith(f"the law bends as far as it may at {knots - 1} of {knots} places")
    first = [
        one
        for one in said
        if "does not follow the data" in one or "where noise and model error leave 1" in one
    ]
    assert len(first) == 2
    assert doubts_among(said) == tuple(first)
    assert max(map(said.index, first)) < said.index(bent_said)
