"""A fit of unknowns of which some are known beside others."""

import numpy as np
import pytest

from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.joint_problem import JointProblem
from fitting.diagnosis.of_files import EACH, OfFiles
from fitting.diagnosis.refit import refit
from fitting.effects import CATALOGUE
from fitting.laws.constant import ConstantModulus

LAW = ConstantModulus(0.5e6, 0.5)
SOFTNESS = 5e13
"""N/m^3 of a root that gives by one."""


class Reads:
    """How much the root of each file gives, and the law in two points beside."""

    def __init__(self, effect, files):
        self.effects, self.parameters = (effect,), effect.parameters
        self.nuisances, self.plate, self.files = (), None, files

    def with_derivatives(self, law, u):
        gives = SOFTNESS / u[: self.files]
        v = np.concatenate([np.log(law.values), gives]).astype(complex)
        dv = np.zeros((2 + len(u), len(v)), complex)
        dv[0, 0] = dv[1, 1] = 1.0
        for k in range(self.files):
            dv[2 + k, 2 + k] = -gives[k] / u[k]
        return v, dv


def fitted(gives, sigma):
    """The clamp's unknowns in two files, of which it was read how much they give."""
    effect = OfFiles(CATALOGUE["clamp_compliance"], 2, EACH)
    measured = np.concatenate([np.log(LAW.values), gives]).astype(complex)
    sigma = np.concatenate([[1e-3, 1e-3], sigma])
    evidence = Evidence(measured, sigma, sigma, np.zeros((2 * len(sigma), 1)), True)
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
    evidence = Evidence(measured, sigma, sigma, np.zeros((8, 1)), True)
    problem = JointProblem(Reads(effect, 2), evidence, LAW, np.array([SOFTNESS, SOFTNESS, EACH]), None)
    x = problem.start + 0.1
    fewer, r, J = problem.condensed(x), problem.residuals(x), problem.jacobian(x)
    assert fewer.shape == (J.shape[1] + 1, J.shape[1] + 1)
    assert len(fewer) < len(r)
    np.testing.assert_allclose(fewer.T @ fewer, np.c_[J, r].T @ np.c_[J, r], rtol=1e-12, atol=1e-9)
    assert problem.condensed(x) is fewer
    assert problem.condensed(x + 0.1) is not fewer
