"""A shear pair that hides nothing."""

import pytest
from shear_pair_problem import ShearPairProblem


@pytest.fixture(scope="module")
def clean():
    return ShearPairProblem(1.0)
