"""A bare beam under a hammer, against beam theory."""

import numpy as np
import pytest

from drivers.simulated.plant.bare import OTHER_RATIO, StruckPlate
from drivers.simulated.plant.effects import Effects, SubstrateStiffness
from drivers.simulated.plant.layered_solid import Sheet
from drivers.simulated.plant.solid_beam import BeamStated
from drivers.simulated.plant.struck_beam import struck_beam

STEEL = Sheet(3e-3, 200e9, 0.3, 7850.0)
ROOTS = {"clamped-free": (1.875104, 4.694091, 7.854757), "clamped-clamped": (4.730041, 7.853205, 10.995608)}


def beam(ends="clamped-free", sheet=STEEL):
    return BeamStated(0.25, 0.012, ends, (sheet,), (), 0.1)


def modes(stated, effects=None, sensor_kg=0.0):
    structure = struck_beam(stated, effects or Effects(), 0.07, 0.12, sensor_kg)
    return StruckPlate((0.07, 0.0), (0.12, 0.0), structure=structure).modes(3)


@pytest.mark.parametrize("ends", ROOTS)
def test_it_rings_as_beam_theory_says(ends):
    f, ratios = modes(beam(ends))
    theory = np.array(ROOTS[ends]) ** 2 / (2 * np.pi * 0.25**2) * np.sqrt(200e9 * 3e-3**2 / (12 * 7850.0))
    # A solid's clamp holds its width too; its depth shears a little.
    np.testing.assert_allclose(f, theory, rtol=7e-3)
    np.testing.assert_allclose(ratios, OTHER_RATIO, rtol=1e-6)


def test_a_sensor_lowers_it_and_a_stiffer_metal_raises_it():
    f, _ = modes(beam())
    assert np.all(modes(beam(), sensor_kg=2e-3)[0] < f)
    np.testing.assert_allclose(
        modes(beam(), Effects(substrate_stiffness=SubstrateStiffness(1.02)))[0], f * 1.02**0.5
    )


def test_a_lossy_metal_adds_half_its_loss_factor():
    _, ratios = modes(beam(sheet=Sheet(3e-3, 200e9, 0.3, 7850.0, 4e-3)))
    assert ratios[0] == pytest.approx(OTHER_RATIO + 2e-3, rel=0.03)


def test_a_place_off_the_beam_and_a_driven_centre_are_refused():
    with pytest.raises(ValueError, match=r"260\.0 mm is off the beam"):
        struck_beam(beam(), Effects(), 0.26, 0.1, 0.0)
    with pytest.raises(ValueError, match="driven in its centre"):
        struck_beam(beam("centre-driven"), Effects(), 0.05, 0.1, 0.0)
