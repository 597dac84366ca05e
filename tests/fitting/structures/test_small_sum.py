"""The sum over the core's modulus, in real numbers where nothing but the core has losses."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la

from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam, ShearPair
from fitting.structures.small import displacement, system_of
from fitting.structures.small_sum import rational_of

FACE = Face(2e-3, 70e9, 0.3, 2700.0)
SANDWICH = Beam(
    *(0.2, 0.02, "clamped-free", FACE),
    constraining=replace(FACE, thickness_m=0.5e-3),
    core=Core(0.3e-3, 0.49, 1000.0, ConstantModulus(1e6, 0.5)),
    pickup_m=0.15,
)
LOSSY = replace(SANDWICH, substrate=replace(FACE, loss_factor=0.01))
SIZE_PA = 1e6


def worst(specimen, omega):
    """Of the sum against a full solve, for cores from a hundredth to a hundred times as stiff."""
    system = system_of(specimen, specimen.parts())
    rational = rational_of(system, omega, SIZE_PA)
    off = []
    for size in (0.01, 0.3, 1.0, 3.0, 100.0):
        for argument in (0.05, 0.5, 1.4):
            G = np.full(len(omega), SIZE_PA * size * np.exp(1j * argument))
            off.append(np.abs(rational.displacement(G) / displacement(system, omega, G) - 1).max())
    return max(off)


@pytest.mark.parametrize("specimen", [SANDWICH, LOSSY, replace(SANDWICH, boundary="clamped-clamped")])
def test_the_sum_is_the_full_solve_whatever_has_losses(specimen):
    assert worst(specimen, 2 * np.pi * np.geomspace(20, 2000, 40)) < 1e-7


@pytest.mark.parametrize("beside", [0.0, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, -1e-3])
def test_beside_a_resonance_without_losses_it_is_so_too(beside):
    s = system_of(SANDWICH, SANDWICH.parts())
    squares = la.eigh(s.K_0.real + SIZE_PA * s.K_1, s.M, eigvals_only=True)
    assert worst(SANDWICH, np.sqrt(squares[:8]) * (1 + beside)) < 1e-6


def test_at_a_resonance_to_the_last_digit_it_is_there_all_the_same():
    pair = ShearPair(1.0, 1, 1e-3, Core(1e-3, 0.5, 0.0, ConstantModulus(1e6, 0.5)))
    assert worst(pair, np.array([1000.0, 900.0])) < 1e-9
