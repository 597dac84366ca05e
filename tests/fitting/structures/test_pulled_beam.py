"""A beam that its two clamps pull along, against the exact frequencies of one with an axial force."""

from dataclasses import replace

import numpy as np
import pytest
from pulled_bar import FACE, LENGTH_M, exact_hz

from fitting.effects import CATALOGUE
from fitting.effects.axial_stress import AxialStressOfBeamEffect
from fitting.structures import Beam
from fitting.structures.small import system_of, widened_system_of
from fitting.structures.small_modes import elastic_modes

BEAM = Beam(LENGTH_M, 0.02, "clamped-clamped", FACE, pickup_m=0.1, slender=True)


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
    assert isinstance(effect, AxialStressOfBeamEffect)
    plate = widened_system_of(BEAM, BEAM.parts())
    u = np.array([12.0])
    K = plate.K_0 + effect.change(plate, u).K
    assert pytest.approx(widened_system_of(BEAM, BEAM.parts(), {"axial": 12e6}).K_0) == K
    assert effect.story({"stress": 12.0}) == "its clamps pull the beam along with 12 MPa in its faces"
    assert "press the beam along with 3 MPa" in effect.story({"stress": -3.0})
