"""A plate's motions of one parity: halves of the whole plate's own answer."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.dynamics.damping import LowRankDamping
from fitting.dynamics.half_plate import HalfPlate
from fitting.plate.plate import Plate

OMEGA, G = 2 * np.pi * 62.0, 0.45e6 * (1 + 0.6j)


@pytest.fixture(scope="module")
def plate(zn1):
    return Plate(replace(zn1, elements=(6, 4)))


def test_even_and_odd_motions_are_all_there_are_and_do_not_couple(plate):
    even, odd = HalfPlate(plate, "even"), HalfPlate(plate, "odd")
    both = np.hstack([even.P.toarray(), odd.P.toarray()])
    np.testing.assert_allclose(both.T @ both, np.eye(plate.size), atol=1e-12)
    coupling = even.down @ plate.K_0 @ odd.P
    assert np.abs(coupling).max() < 1e-9 * np.abs(plate.K_0).max()


@pytest.mark.parametrize("parity", ["even", "odd"])
def test_a_half_answers_as_the_dense_plate_on_its_motions(plate, parity):
    half = HalfPlate(plate, parity)
    rng, n = np.random.default_rng(2), half.P.shape[1]
    U, loads = rng.standard_normal((n, 2)), rng.standard_normal((n, 2))
    damping = LowRankDamping(U, np.array([3.0, 0.5]), np.arange(2))
    found = half.solver(OMEGA, G, damping)(loads)
    P = half.P.toarray()
    A = P.T @ (plate.K_0 + G * plate.K_1 - OMEGA**2 * plate.M) @ P + 1j * OMEGA * (U * damping.d) @ U.T
    np.testing.assert_allclose(found, np.linalg.solve(A, loads), rtol=1e-6, atol=1e-9 * np.abs(found).max())


def test_columns_are_found_again_where_the_lines_have_put_them(plate):
    half = HalfPlate(plate, "even")
    np.testing.assert_array_equal(half.P.toarray()[:, half.place], plate.even.toarray())
