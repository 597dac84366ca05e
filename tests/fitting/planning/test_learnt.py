"""What a rival has learnt of a gain."""

import numpy as np
import pytest
from shear_pair_problem import GAIN, HIGH, ShearPairProblem

from fitting.diagnosis.inference.usual_law import polished
from fitting.planning.learnt import learnt, scales


@pytest.fixture(scope="module")
def begun():
    return ShearPairProblem(HIGH).begun


@pytest.fixture(scope="module")
def fitted(begun):
    start = np.append(begun.problem.as_stated, HIGH)
    return polished(begun.problem, [GAIN], begun.evidence, begun.none.law, start)


def test_errors_that_the_model_cannot_make_are_not_learnt(begun, fitted):
    nothing = np.zeros((begun.evidence.count, 2))
    found = learnt(begun.problem, begun.evidence, fitted, nothing)
    assert found.errors.tolist() == [0.0, 0.0]
    covariance = found.root @ found.root.T
    k = fitted.jacobian.shape[1]
    np.testing.assert_allclose(covariance[k:, k:] / covariance[-1, -1], np.eye(2), atol=1e-9)
    np.testing.assert_allclose(covariance[:k, k:], 0, atol=1e-9)


def test_a_number_that_is_fitted_in_its_logarithm_scales_by_itself(fitted):
    found = scales(fitted)
    assert found[: fitted.stated].tolist() == [1.0] * fitted.stated
    assert found[-1] == (fitted.u[-1] if GAIN.parameters[0].logarithmic else 1.0)
