import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fitting.diagnosis.inference.whitening import Whitening


@given(st.integers(0, 1000), st.floats(0.01, 30))
def test_whitened_size_is_that_of_the_whole_covariance(seed, size):
    rng = np.random.default_rng(seed)
    B, r = size * rng.normal(size=(40, 3)), rng.normal(size=40)
    expected = r @ np.linalg.solve(np.eye(40) + B @ B.T, r)
    white = Whitening.of(B)(r)
    assert np.isclose(white @ white, expected)


def test_a_large_nuisance_takes_its_direction_out():
    b = np.ones((30, 1))
    white = Whitening.of(1e6 * b)(np.full(30, 5.0))
    assert np.abs(white).max() < 1e-4
