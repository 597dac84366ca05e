"""A fit of unknowns of which some are known beside others."""

from unittest import mock

import numpy as np
import pytest

from fitting.data.readings import Readings
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.joint_problem import JointProblem
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.several.of_files import EACH, OfFiles
from fitting.effects import CATALOGUE
from fitting.laws.constant import ConstantModulus
from fitting.laws.smooth import Smooth

LAW = ConstantModulus(0.5e6, 0.5)
SOFTNESS = 5e13
"""N/m^3 of a root that gives by one."""


class Reads:
    """How much the root of each file gives, and the law in two points beside."""

    def __init__(self, effect, files):
        self.effects, self.parameters, self.derivatives_cost_extra = (effect,), effect.parameters, True
        self.nuisances, self.plate, self.files = (), None, files

    def velocity(self, law, u):
        return np.concatenate([np.log(law.values), SOFTNESS / u[: self.files]]).astype(complex)

    def with_derivatives(self, law, u):
        gives, v = SOFTNESS / u[: self.files], self.velocity(law, u)
        dv = np.zeros((2 + len(u), len(v)), complex)
        dv[0, 0] = dv[1, 1] = 1.0
        for k in range(self.files):
            dv[2 + k, 2 + k] = -gives[k] / u[k]
        return v, dv


class OfSmooth(Reads):
    """The same of a law with four numbers."""

    def with_derivatives(self, law, u):
        v, dv = self.velocity(law, u), np.zeros((4 + len(u), 4 + self.files), complex)
        dv[:4, :4] = np.eye(4)
        for k in range(self.files):
            dv[4 + k, 4 + k] = -SOFTNESS / u[k] ** 2
        return v, dv


def fitted(gives, sigma):
    """The clamp's unknowns in two files, of which it was read how much they give."""
    effect = OfFiles(CATALOGUE["clamp_compliance"], 2, EACH)
    measured = np.concatenate([np.log(LAW.values), gives]).astype(complex)
    sigma = np.concatenate([[1e-3, 1e-3], sigma])
    evidence = Evidence(Readings(measured), sigma, sigma, np.zeros((2 * len(sigma), 1)), True)
    found = refit(Reads(effect, 2), evidence, LAW, np.array([SOFTNESS, SOFTNESS, EACH]))
    return found, found.u[:2] / SOFTNESS


def test_a_mounting_that_was_not_read_is_expected_to_be_like_the_first():
    found, k = fitted([2.0, 2.0], [0.01, 1e9])
    assert k == pytest.approx([0.5, 0.5], rel=1e-3)
    # As well as the first is known, and by a factor e otherwise.
    error = np.sqrt(np.diag(found.covariance))[2:]
    assert error == pytest.approx([0.005, 1.0], rel=1e-2)


def test_a_mounting_that_was_read_is_what_it_is_and_pays_for_its_distance():
    found, k = fitted([1.0, np.e**2], [1e-3, 1e-3])
    assert k == pytest.approx([1.0, np.exp(-2)], rel=1e-3)
    # Two standard deviations of a mounting from the first.
    assert found.chi2 == pytest.approx(4.0, rel=1e-2)
    assert found.residuals[found.data :] == pytest.approx([-2.0], rel=1e-2)


def test_what_a_step_is_given_has_the_products_of_all_rows():
    effect = OfFiles(CATALOGUE["clamp_compliance"], 2, EACH)
    measured = np.concatenate([np.log(LAW.values), [2.0, 0.5]]).astype(complex)
    sigma = np.array([1e-3, 1e-3, 0.01, 0.1])
    evidence = Evidence(Readings(measured), sigma, sigma, np.zeros((8, 1)), True)
    problem = JointProblem(Reads(effect, 2), evidence, LAW, np.array([SOFTNESS, SOFTNESS, EACH]), None)
    x = problem.start + 0.1
    short, fewer, r, J = problem.shortened(x), problem.condensed(x), problem.residuals(x), problem.jacobian(x)
    assert fewer.shape == (J.shape[1] + 1, J.shape[1])
    assert len(fewer) == len(short) < len(r)
    both = np.c_[fewer, short]
    np.testing.assert_allclose(both.T @ both, np.c_[J, r].T @ np.c_[J, r], rtol=1e-12, atol=1e-9)


@pytest.mark.parametrize("alike", [0.0, 1.0, 1 - 1e-9], ids=["few rows", "one column twice", "almost"])
def test_so_it_has_where_columns_are_made_of_others_or_rows_are_few(alike):
    rng = np.random.default_rng(1)
    r, J = rng.normal(size=6), rng.normal(size=(6, 9 if not alike else 3))
    J[:, -1] += alike * (J[:, 0] - J[:, -1])
    problem = mock.Mock(JointProblem, residuals=lambda x: r, jacobian=lambda x: J)
    x = np.zeros(J.shape[1])
    short, fewer = JointProblem.shortened(problem, x), JointProblem.condensed(problem, x)
    assert len(fewer) == len(short) == min(len(r), len(x) + 1)
    both = np.c_[fewer, short]
    np.testing.assert_allclose(both.T @ both, np.c_[J, r].T @ np.c_[J, r], rtol=1e-12, atol=1e-12)


def test_no_slope_is_worked_out_where_a_step_is_not_taken():
    effect = OfFiles(CATALOGUE["clamp_compliance"], 2, EACH)
    measured = np.concatenate([np.log(LAW.values), [2.0, 0.5]]).astype(complex)
    sigma = np.array([1e-3, 1e-3, 0.01, 0.1])
    evidence = Evidence(Readings(measured), sigma, sigma, np.zeros((8, 1)), True)
    reads = Reads(effect, 2)
    problem = JointProblem(reads, evidence, LAW, np.array([SOFTNESS, SOFTNESS, EACH]), None)
    x = problem.start + 0.1
    with mock.patch.object(reads, "with_derivatives", wraps=reads.with_derivatives) as slopes:
        problem.shortened(x + 0.1)
        problem.shortened(x)
        assert not slopes.called
        problem.condensed(x)
        problem.jacobian(x)
        assert slopes.call_count == 1


def test_a_law_that_no_core_can_have_pays_for_it_and_is_followed_to_one_that_can():
    effect = OfFiles(CATALOGUE["clamp_compliance"], 2, EACH)
    steep = Smooth((10.0, 1000.0), (1e5, 4e6), (0.4, 0.3))
    measured = np.concatenate([np.log(steep.values), [2.0, 0.5]]).astype(complex)
    sigma = np.array([1.0] * 4 + [0.01, 0.1])
    evidence = Evidence(Readings(measured), sigma, sigma, np.zeros((12, 1)), True)
    start = np.array([SOFTNESS, SOFTNESS, EACH])
    problem = JointProblem(OfSmooth(effect, 2), evidence, steep, start, None)
    x, h = problem.start + 0.01, 1e-6
    each = [(problem.residuals(x + s) - problem.residuals(x - s)) / (2 * h) for s in h * np.eye(len(x))]
    np.testing.assert_allclose(problem.jacobian(x), np.transpose(each), rtol=1e-4, atol=1e-4)
    found = refit(OfSmooth(effect, 2), evidence, steep, start)
    assert found.law.breaches().max() < 0.6 * steep.breaches().max()
    assert found.chi2 < np.sum(steep.breaches() ** 2)


class Ends(Reads):
    """The same up to where a structure has less than no mass."""

    def velocity(self, law, u):
        if SOFTNESS / u[0] > 1.5:
            raise np.linalg.LinAlgError("not positive definite")
        return super().velocity(law, u)


def test_a_step_to_a_structure_that_cannot_be_is_not_taken_and_such_a_start_is_refused():
    effect = OfFiles(CATALOGUE["clamp_compliance"], 2, EACH)
    measured = np.concatenate([np.log(LAW.values), [2.0, 0.5]]).astype(complex)
    sigma = np.array([1e-3, 1e-3, 0.01, 0.1])
    evidence = Evidence(Readings(measured), sigma, sigma, np.zeros((8, 1)), True)
    found = refit(Ends(effect, 2), evidence, LAW, np.array([SOFTNESS, SOFTNESS, EACH]))
    assert 1.2 < SOFTNESS / found.u[0] <= 1.5
    with pytest.raises(np.linalg.LinAlgError):
        refit(Ends(effect, 2), evidence, LAW, np.array([0.5 * SOFTNESS, SOFTNESS, EACH]))
