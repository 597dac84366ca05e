"""A mass that depends on frequency, put on a structure by its receptances, beside the structure with it."""

import numpy as np
import pytest

from fitting.diagnosis.response.swinging_part import Loaded

OMEGA = 2 * np.pi * np.array([9.0, 31.0, 55.0, 140.0])
FELT_KG = np.array([0.02, 0.3 - 0.1j, -0.4 - 0.5j, -0.03])
DOFS = 5


@pytest.fixture
def structure():
    rng = np.random.default_rng(3)
    half = rng.normal(size=(DOFS, DOFS))
    M = np.eye(DOFS) + 0.1 * half @ half.T
    K = (1 + 0.05j) * (2 * np.pi * 40.0) ** 2 * (np.eye(DOFS) + half @ half.T)
    return M, K, *rng.normal(size=(3, DOFS))


def receptances(M, K, load, observe, place):
    found = []
    for w in OMEGA:
        A = K - w**2 * M
        q, c = np.linalg.solve(A, load), np.linalg.solve(A, place)
        found.append([observe @ q, place @ q, observe @ c, place @ c])
    return np.array(found).T


def with_the_mass(M, K, load, observe, place, base, felt_kg):
    found = []
    for w, m in zip(OMEGA, felt_kg, strict=True):
        A = K - w**2 * (M + m * np.outer(place, place))
        found.append(observe @ np.linalg.solve(A, load - m * base * place))
    return np.array(found)


@pytest.mark.parametrize("base", [0.0, 1.0])
def test_it_is_the_structure_with_that_mass(structure, base):
    on_it = Loaded(*receptances(*structure), FELT_KG, OMEGA**2, base)
    expected = with_the_mass(*structure, base, FELT_KG)
    np.testing.assert_allclose(on_it.x, expected, rtol=1e-10)
    assert np.abs(on_it.x / on_it.lo - 1).max() > 0.1


@pytest.mark.parametrize("base", [0.0, 1.0])
def test_its_derivatives_are_those_of_differences(structure, base):
    known, square = receptances(*structure), OMEGA**2
    on_it, h = Loaded(*known, FELT_KG, square, base), 1e-6
    for n, direction in enumerate(np.eye(4)[:, :, None] * np.abs(known)):
        up, down = (Loaded(*(known + s * h * direction), FELT_KG, square, base).x for s in (1, -1))
        found = on_it.along(*direction)
        np.testing.assert_allclose(found, (up - down) / (2 * h), rtol=1e-6, err_msg=str(n))
    up, down = (Loaded(*known, FELT_KG + s * h, square, base).x for s in (1, -1))
    np.testing.assert_allclose(on_it.by_felt, (up - down) / (2 * h), rtol=1e-6)
