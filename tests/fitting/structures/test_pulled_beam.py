"""A beam that its two clamps pull along, against the exact frequencies of one with an axial force."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from fitting.effects import CATALOGUE
from fitting.effects.axial_stress import AxialStressEffect
from fitting.specimen import Face
from fitting.structures import Beam
from fitting.structures.small import system_of, widened_system_of
from fitting.structures.small_modes import elastic_modes

YOUNG_PA, THICKNESS_M, LENGTH_M, DENSITY = 70e9, 2e-3, 0.28, 2700.0
BEAM = Beam(
    LENGTH_M,
    0.02,
    "clamped-clamped",
    Face(THICKNESS_M, YOUNG_PA, 0.3, DENSITY),
    pickup_m=0.1,
    slender=True,
)


def exact_hz(stress_pa, count):
    """2 a b (1 - cosh a cos b) + (a^2 - b^2) sinh a sin b = 0, both ends clamped (over cosh a here)."""
    EI, m, N = YOUNG_PA * THICKNESS_M**3 / 12, DENSITY * THICKNESS_M, stress_pa * THICKNESS_M

    def left(omega):
        root = np.sqrt((N / 2 / EI) ** 2 + m * omega**2 / EI)
        a, b = (np.sqrt(root + s * N / 2 / EI) * LENGTH_M for s in (1, -1))
        return 2 * a * b * (1 / np.cosh(a) - np.cos(b)) + (a**2 - b**2) * np.tanh(a) * np.sin(b)

    omega = 2 * np.pi * np.linspace(5, 2500, 5000)
    values = np.array([left(w) for w in omega])
    at = np.flatnonzero(values[1:] * values[:-1] < 0)[:count]
    return np.array([brentq(left, omega[k], omega[k + 1]) for k in at]) / (2 * np.pi)


@pytest.mark.parametrize("stress_mpa", [-8.0, -2.0, 0.0, 2.0, 20.0])
def test_frequencies_are_those_of_a_bar_with_an_axial_force(stress_mpa):
    pulled = system_of(BEAM, BEAM.parts(), {"axial": 1e6 * stress_mpa})
    found = [m.frequency_hz for m in elastic_modes(pulled, None, 4)]
    assert found == pytest.approx(exact_hz(1e6 * stress_mpa, 4), rel=1e-4)


def test_only_two_clamps_pull_and_a_laboratory_does_not_know_how_much():
    assert "axial" in BEAM.numbers
    assert BEAM.tolerance("axial") == 2e6
    assert replace(BEAM, exact=True).tolerance("axial") == 0.0
    assert BEAM.stated_number("axial") == (0.0, 1e-6, "MPa")
    for other in ("clamped-free", "centre-driven", "free-free"):
        assert "axial" not in replace(BEAM, boundary=other).numbers
        assert CATALOGUE["axial_stress"].standing_on(replace(BEAM, boundary=other)) is None


def test_more_than_that_is_an_effect_of_its_own():
    effect = CATALOGUE["axial_stress"].standing_on(BEAM)
    assert isinstance(effect, AxialStressEffect)
    plate = widened_system_of(BEAM, BEAM.parts())
    u = np.array([12.0])
    K = plate.K_0 + effect.change(plate, u).K
    assert pytest.approx(widened_system_of(BEAM, BEAM.parts(), {"axial": 12e6}).K_0) == K
    assert "pulled along by its clamps, 12 MPa" in effect.story({"stress": 12.0})
    assert "pressed along by its clamps, 3 MPa" in effect.story({"stress": -3.0})
