"""A response by its resonances: the parts add up, and each moves as its own mode does."""

import numpy as np
import pytest
from scipy.linalg import eigh

from fitting.laws.constant import ConstantModulus
from fitting.reduced.resonance_parts import Answers, parts_of

LAW = ConstantModulus(1e6, 0.2)
OMEGA = 2 * np.pi * np.linspace(20.0, 400.0, 60)
G = LAW.modulus(OMEGA)
LINKS = np.eye(5) - np.eye(5, k=-1)
# Five masses in a row on springs with a core beside each.
M = np.diag([1.0, 0.9, 1.1, 0.8, 1.2])
K_0 = (LINKS.T @ np.diag([1.0, 0.8, 1.2, 0.9, 1.1]) @ LINKS * 1e6).astype(complex)
K_1 = LINKS.T @ np.diag([0.3, 0.1, 0.2, 0.1, 0.3]) @ LINKS
LAM, PHI = eigh(K_0.real + G[0].real * K_1, M)
NATURAL_HZ = np.sqrt(LAM) / (2 * np.pi)


def answers(stiffer=0.0):
    Z = K_0 + stiffer + G[:, None, None] * K_1 - OMEGA[:, None, None] ** 2 * M
    sides = np.stack([np.ones(5), np.eye(5)[4]], axis=1).astype(complex)
    q, z = np.moveaxis(np.linalg.solve(Z, np.tile(sides, (len(OMEGA), 1, 1))), 2, 0)
    return Answers(K_0, K_1, M, np.eye(5)[4], q, z, G)


def test_the_parts_add_up_to_the_response_and_to_its_derivative():
    whole, parts = answers(), parts_of(answers(), LAW, NATURAL_HZ[0] - 1, NATURAL_HZ[2] + 1)
    assert [p.frequency_hz for p in parts] == pytest.approx([*NATURAL_HZ[:3], NATURAL_HZ[2] + 1])
    np.testing.assert_allclose(sum(p.displacement for p in parts), whole.displacement, rtol=1e-9)
    np.testing.assert_allclose(sum(p.by_frequency for p in parts), whole.by_frequency(), rtol=1e-9)


@pytest.mark.parametrize("r", [0, 1, 2])
def test_a_resonance_moves_as_its_mode_is_stiffer(r):
    """About its own frequency, where the real mode is the motion; damping is what mixes others in."""
    part = parts_of(answers(), LAW, NATURAL_HZ[0] - 1, NATURAL_HZ[2] + 1)[r]
    s = 1e-5
    pulled = M @ PHI[:, r]
    stiffer = 2 * s * LAM[r] * np.outer(pulled, pulled)
    expected = (answers(stiffer).displacement - answers().displacement) / s
    near = np.argmin(np.abs(OMEGA / (2 * np.pi) - NATURAL_HZ[r]))
    assert abs(part.by_frequency[near] / expected[near] - 1) < 0.2
    assert np.argmax(np.abs(part.by_frequency)) in (near - 1, near, near + 1)


@pytest.mark.parametrize("last", [0.5, 1.05])
def test_one_resonance_or_none_is_all_in_one(last):
    (part,) = parts_of(answers(), LAW, 0.4 * NATURAL_HZ[0], last * NATURAL_HZ[0])
    assert part.frequency_hz == pytest.approx(np.sqrt(0.4 * last) * NATURAL_HZ[0])
    np.testing.assert_array_equal(part.displacement, answers().displacement)
    np.testing.assert_array_equal(part.by_frequency, answers().by_frequency())
