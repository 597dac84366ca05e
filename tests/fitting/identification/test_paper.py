from dataclasses import replace

import numpy as np
import pytest
from paper_law import TABLE_4

from fitting.errors import TooFewPoints
from fitting.identification import paper
from fitting.identification.paper import PaperProblem, fit_paper
from fitting.laws.fractional_zener import FractionalZener
from fitting.laws.isd112 import Isd112


@pytest.fixture(scope="module")
def problem(table5, zn1_models):
    return PaperProblem.of(table5, zn1_models.real_modes, "relative")


@pytest.fixture(scope="module")
def fitted(problem, zn1):
    return fit_paper(problem, zn1.core.law)


def rms_percent(problem, law):
    return 100 * np.sqrt(np.mean(problem.linearise(law)[0] ** 2))


def test_weights_are_the_printed_ones(problem):
    np.testing.assert_array_equal(problem.weight, [0.06, 0.2, 0.06] * 3)


def test_weights_of_the_file_replace_the_printed_ones(table5, zn1_models):
    own = PaperProblem.of(replace(table5, weight=np.ones(9)), zn1_models.real_modes, "relative")
    np.testing.assert_array_equal(own.weight, 1)


def test_table_5_ends_within_the_known_remainder(problem, fitted):
    assert fitted.converged
    assert fitted.criterion_met is False
    assert rms_percent(problem, fitted.law) < 6.2


def test_the_end_does_not_depend_on_the_start(problem, fitted):
    one = fitted.law
    other = fit_paper(problem, FractionalZener(0.25e6, 6e6, 1e-4, 0.8)).law
    np.testing.assert_allclose(other.values, one.values, rtol=2e-2)
    assert rms_percent(problem, other) == pytest.approx(rms_percent(problem, one), abs=0.02)


def test_the_end_is_the_least_of_the_weighted_differences(problem, fitted):
    # Where Eq. (25) rests, S^T W_x^T W_x dx = 0: the weights of the parameters only slow it down.
    law = fitted.law
    np.testing.assert_allclose(paper.refit(problem, law).values, law.values, rtol=5e-3)


def test_first_steps_are_the_printed_ones(problem, zn1, monkeypatch):
    monkeypatch.setattr(paper, "MOST_STEPS", 5)
    fit = fit_paper(problem, zn1.core.law)
    law = zn1.core.law
    for _ in range(5):
        dx, S = problem.linearise(law)
        W = np.diag(problem.weight)
        step = np.linalg.inv(S.T @ W.T @ W @ S + 0.25**2 * np.eye(4)) @ S.T @ W.T @ W @ dx
        law = law.with_values(law.values * (1 - step))
    # differences over a step of 1e-4 carry the eigensolver's rounding
    np.testing.assert_allclose(fit.law.values, law.values, rtol=1e-5)
    assert not fit.converged
    assert fit.iterations == 5


def test_criterion_stops_the_iteration_where_it_is_met(table5, zn1, zn1_models):
    clean = PaperProblem.of(table5, zn1_models.real_modes, "relative")
    measured = replace(table5, velocity_m_s=np.abs(clean.velocity([TABLE_4])[0]))
    fit = fit_paper(PaperProblem.of(measured, zn1_models.real_modes, "relative"), zn1.core.law)
    assert fit.criterion_met
    assert fit.converged
    assert fit.iterations < 20


def test_sensitivity_follows_eq_20(problem):
    _, S = problem.linearise(TABLE_4)
    h = 1e-5  # below, rounding shows; from here to 1e-3 nothing changes
    for k in range(4):
        b = TABLE_4.values
        up, down = (TABLE_4.with_values(b * (1 + s * h * (np.arange(4) == k))) for s in (1, -1))
        theory = np.abs(problem.velocity([up, down]))
        central = (theory[0] - theory[1]) / (2 * h) / np.abs(problem.sweep.response_m_s)
        np.testing.assert_allclose(S[:, k], central, atol=2e-4 * np.abs(S).max())


def test_the_papers_fit_refuses_a_law_without_parameters_and_a_single_point(problem, table5, zn1, zn1_models):
    with pytest.raises(TooFewPoints, match="no parameter"):
        fit_paper(problem, Isd112())
    with pytest.raises(TooFewPoints, match="1 point"):
        fit_paper(problem.take(np.array([0])), zn1.core.law)
