"""What of a curve no smooth core explains."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_cases import LAW, pair, sweep

from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.problem.smooth_core import unexplained

PAIR = pair(0.2533)


def left(factor=lambda f: 1.0, *, guess=LAW, specimen=PAIR, noise=0.0):
    s = sweep(specimen, points=200, noise=noise)
    s = replace(s, velocity_m_s=s.velocity_m_s * factor(s.frequency_hz))
    rational = SmallProblem.of_small(s, PAIR).rational
    return s.frequency_hz, unexplained(s, rational, PAIR.reads, guess)[0]


@pytest.mark.parametrize("times", [0.1, 1.0, 8.0])
def test_a_modulus_ten_times_off_is_found(times):
    guess = replace(LAW, g0_pa=LAW.g0_pa * times, ginf_pa=LAW.ginf_pa * times)
    _, rest = left(guess=guess)
    assert np.abs(rest).max() < 1e-3


@pytest.mark.parametrize("reads", ["absolute", "relative"])
def test_a_wrong_mass_a_gain_and_a_delay_leave_nothing(reads):
    other = replace(pair(0.2533), mass_kg=0.27)
    s = sweep(other, points=200, noise=0.0)
    v = s.velocity_m_s * 1.03 * np.exp(-2j * np.pi * s.frequency_hz * 8e-6)
    if reads == "relative":
        v = v - s.commanded_m_s2 / (1j * s.omega)
    small = SmallProblem.of_small(replace(s, velocity_m_s=v), replace(PAIR, reads=reads))
    rest, _ = unexplained(small.sweep, small.rational, reads, LAW)
    assert np.median(np.abs(rest)) < 2e-3
    assert np.abs(rest).max() < 0.02


def test_a_stretch_that_is_off_is_not_followed():
    def step(f):
        return np.where((f > 280) & (f < 330), 1.05, 1.0)

    f, rest = left(step, noise=5e-4)
    there = step(f) > 1
    np.testing.assert_allclose(np.abs(rest[there]), 0.05, atol=0.01)
    assert np.median(np.abs(rest[~there])) < 1.5 * 1.18 * 5e-4
    # Wherever a search begins it ends there.
    stiff = replace(LAW, g0_pa=3 * LAW.g0_pa, ginf_pa=3 * LAW.ginf_pa)
    _, again = left(step, noise=5e-4, guess=stiff)
    np.testing.assert_allclose(again, rest, atol=1e-3)


def test_a_core_with_structure_is_followed():
    """Two elements, which the guess is not: nothing in it stands out."""
    slow = replace(LAW, tau_s=3e-3)

    def both(f):
        return LAW.modulus(2 * np.pi * f) + 0.5 * slow.modulus(2 * np.pi * f)

    s = sweep(PAIR, points=200, noise=0.0)
    problem = SmallProblem.of_small(s, PAIR)
    v = (
        s.velocity_m_s * 0
        + 1j * s.omega * s.commanded_m_s2 * problem.rational.displacement(both(s.frequency_hz))
        + s.commanded_m_s2 / (1j * s.omega)
    )
    rest, _ = unexplained(replace(s, velocity_m_s=v), problem.rational, PAIR.reads, LAW)
    assert np.abs(rest).max() < 4e-3
