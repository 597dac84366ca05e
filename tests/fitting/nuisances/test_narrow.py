"""What the numbers of narrow resonances change of each one's stiffness."""

import numpy as np
import pytest

from fitting.nuisances.narrow import THEORY, NarrowResonance, NarrowResonances

FIRST = NarrowResonance(1, 200.0, 1e-3, 2e-3, 0.01, 1e-4, 3e-4)
THIRD = NarrowResonance(3, 600.0, 2e-3, -1e-3, 0.02, 2e-4, 5e-4)
BOTH = NarrowResonances((FIRST, THIRD))


def test_each_has_two_numbers_and_all_one_in_common():
    names = [n.name for n in BOTH.numbers]
    assert names == ["resonance_1", "loss_1", "resonance_3", "loss_3", THEORY]
    assert NarrowResonances().numbers == ()


def test_a_frequency_moves_with_half_the_stiffness_and_a_loss_is_its_imaginary_part():
    kappa = BOTH.stiffer(np.array([1.0, 0.0, 0.0, 1.0, 0.0]))
    # A frequency goes with the square root of a stiffness.
    assert np.sqrt(1 + kappa[0]) == pytest.approx(np.exp(FIRST.by_itself))
    assert np.angle(1 + kappa[1]) == pytest.approx(THIRD.loss_by_itself)
    assert np.abs(BOTH.stiffer(np.zeros(5))).max() == 0


def test_the_theory_moves_all_of_them_each_in_its_own_sense():
    first, third = BOTH.stiffer(np.array([0.0, 0.0, 0.0, 0.0, 1.0]))
    assert first.real > 0 > third.real
    assert first == pytest.approx(np.exp(2 * FIRST.by_theory + 1j * FIRST.loss_by_theory) - 1)


def test_derivatives_are_those_of_the_stiffness():
    z, h = np.linspace(-2, 2, 5), 1e-6
    by = BOTH.by(z)
    for k, step in enumerate(h * np.eye(5)):
        assert by[k] == pytest.approx((BOTH.stiffer(z + step) - BOTH.stiffer(z - step)) / (2 * h), abs=1e-9)
