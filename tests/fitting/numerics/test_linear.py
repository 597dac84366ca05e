"""Sparse and chained solvers against dense ones of numpy."""

import numpy as np
import pytest
import scipy.sparse as sp

from fitting.numerics.linear import Chain, factorise, times, with_damping

SIZES = (2, 4, 3)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


@pytest.fixture
def chained(rng):
    """A symmetric complex matrix whose lines are coupled to the next ones alone."""
    n = sum(SIZES)
    A = rng.normal(size=(n, n)) + 1j * rng.normal(size=(n, n))
    line = np.repeat(np.arange(len(SIZES)), SIZES)
    A[np.abs(line[:, None] - line) > 1] = 0
    return A + A.T + 20 * np.eye(n)


def test_a_chain_s_factors_solve_as_the_dense_matrix_does(chained, rng):
    chain, b = Chain(SIZES), rng.normal(size=(sum(SIZES), 2))
    blocks = chain.blocks(sp.coo_array(chained))
    np.testing.assert_allclose(chain.times(blocks, b), chained @ b, rtol=1e-13)
    np.testing.assert_allclose(chain.factorise(blocks)(b), np.linalg.solve(chained, b), rtol=1e-11)


def test_a_line_that_moves_freely_is_said_so():
    chain = Chain((1, 1))
    with pytest.raises(np.linalg.LinAlgError, match="moves freely"):
        chain.factorise(chain.blocks(sp.coo_array(np.diag([1.0, 0.0]))))


def test_a_sparse_factor_solves_for_real_and_complex_loads(chained, rng):
    for A in (chained, chained.real):
        b = rng.normal(size=(len(A), 2)) + 1j * rng.normal(size=(len(A), 2))
        np.testing.assert_allclose(factorise(sp.csc_array(A))(b), np.linalg.solve(A, b), rtol=1e-11)


def test_a_real_matrix_times_complex_columns_is_the_plain_product(rng):
    A = sp.random_array((6, 5), density=0.5, rng=rng)
    for shape in ((5,), (5, 3)):
        X = rng.normal(size=shape) + 1j * rng.normal(size=shape)
        np.testing.assert_allclose(times(A, X), A.toarray() @ X, rtol=1e-13)


def test_damping_of_a_few_modes_is_added_to_the_solver(chained, rng):
    U, d, omega = rng.normal(size=(len(chained), 2)), np.array([0.3, 0.7]), 5.0
    b = rng.normal(size=(len(chained), 1)).astype(complex)
    solve = with_damping(lambda x: np.linalg.solve(chained, x), omega, U, d)
    np.testing.assert_allclose(solve(b), np.linalg.solve(chained + 1j * omega * U * d @ U.T, b), rtol=1e-11)
