"""Beam and shear pair as they stand on the shaker, against formulas that the plant does not use."""

from dataclasses import replace

import numpy as np
import pytest

from drivers.simulated.plant import effects as e
from drivers.simulated.plant.built import (
    beam_stated,
    mounted_beam,
    mounted_pair,
    reduced_beam,
    reduced_pair,
    refuse_effects,
)
from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.shaken import ShakenPlate
from drivers.simulated.plant.solid_beam import BeamStated, Sheet
from drivers.simulated.plant.solid_pad import PairStated

LAW = MaxwellLaw(4e6, (2e6, 3e6, 6e6), (5e-3, 5e-4, 5e-5))
PAIR = PairStated(0.5, 2, 4e-3, 40e-3, 10e-3, 1100.0)
EDGES = 1 - 0.1155 * PAIR.thickness_m / 15e-3
"""What free edges leave of G A / t; `test_solid_pad.py` has its size."""
FACE = Sheet(1e-3, 70e9, 0.3, 2700.0)
BEAM = BeamStated(0.2, 0.02, "clamped-free", (FACE, Sheet(0.5e-3, 2 * 1.49, 0.49, 1000.0), FACE), (1,), 0.15)


@pytest.fixture(scope="module")
def pair():
    return reduced_pair(PAIR)


@pytest.fixture(scope="module")
def beam():
    return reduced_beam(BEAM, LAW, pieces=6)


def transmissibility(mounted: Mounted, frequency_hz: float) -> complex:
    seen = ShakenPlate(mounted=mounted).steady_state(frequency_hz)
    return seen["spot_velocity"] / seen["base_velocity"]


@pytest.mark.parametrize("frequency_hz", [60.0, 200.0, 320.0, 600.0])
def test_the_mass_moves_as_by_the_wave_in_a_pad(pair, frequency_hz):
    """u = A cos kz + B sin kz, G k A u'(t) = m w^2 u(t): closed form, with the edges' share of G."""
    w, volume = 2 * np.pi * frequency_hz, PAIR.volume_m3
    G, t, area = EDGES * complex(LAW.modulus(w)), PAIR.thickness_m, volume / PAIR.thickness_m
    k = w * np.sqrt(PAIR.density_kg_m3 / G)
    exact = 1 / (np.cos(k * t) - PAIR.mass_kg * w**2 / (G * area * k) * np.sin(k * t))
    found = transmissibility(mounted_pair(PAIR, pair, LAW, e.Effects()), frequency_hz)
    assert found == pytest.approx(exact, rel=4e-3)


def test_a_mass_that_nobody_weighed_is_one_that_everybody_did(pair):
    hidden = mounted_pair(PAIR, pair, LAW, e.Effects(added_mass=e.AddedMass(0.02, 0.0, 0.0)))
    known = replace(PAIR, mass_kg=0.52)
    stated = mounted_pair(known, reduced_pair(known), LAW, e.Effects())
    assert transmissibility(hidden, 150.0) == pytest.approx(transmissibility(stated, 150.0), rel=1e-5)


def test_a_slow_base_carries_the_beam_with_it(beam):
    assert transmissibility(mounted_beam(BEAM, beam, LAW, e.Effects()), 1.0) == pytest.approx(1.0, abs=2e-3)


def test_a_stiffer_substrate_and_a_thicker_core_change_the_beam(beam):
    plain = mounted_beam(BEAM, beam, LAW, e.Effects()).structure
    stiff = mounted_beam(BEAM, beam, LAW, e.Effects(substrate_stiffness=e.SubstrateStiffness(1.1))).structure
    grown = stiff.K - plain.K
    assert np.trace(grown) > 0
    np.testing.assert_allclose(grown, 0.1 * beam.K_faces[0])
    thick = beam_stated(BEAM, e.Effects(core_thickness=e.CoreThickness(1.1)))
    assert thick.sheets[1].thickness_m == pytest.approx(0.55e-3)
    assert thick.sheets[0] == FACE


def test_a_mass_sits_where_it_is_said_or_at_the_tip_and_a_clamp_may_yield(beam):
    plain = mounted_beam(BEAM, beam, LAW, e.Effects()).structure
    for added, at in ((e.AddedMass(1e-3, 0.08), 0.08), (e.AddedMass(1e-3), 0.2)):
        hidden = e.Effects(added_mass=added)
        there = reduced_beam(BEAM, LAW, pieces=6, effects=hidden)
        loads = [mounted_beam(BEAM, there, LAW, has).structure.loads for has in (hidden, e.Effects())]
        # Mass times what the base moves of it: heave, and pitch by its lever.
        heave, pitch = (loads[0] - loads[1]).T
        np.testing.assert_allclose(heave, -1e-3 * there.readings[2], atol=1e-12)
        np.testing.assert_allclose(pitch, at * heave, atol=1e-12)
    soft = e.Effects(clamp_compliance=e.ClampCompliance(3e12, 3e12))
    yields = mounted_beam(BEAM, reduced_beam(BEAM, LAW, pieces=6, effects=soft), LAW, soft).structure
    assert abs(yields.response(2 * np.pi)[:, 0] @ yields.readings[1]) > 1.02 * abs(
        plain.response(2 * np.pi)[:, 0] @ plain.readings[1]
    )
    with pytest.raises(ValueError, match="added_mass at 210"):
        reduced_beam(BEAM, LAW, effects=e.Effects(added_mass=e.AddedMass(1e-3, 0.21)))


@pytest.mark.parametrize("ends", ["clamped-free", "clamped-clamped", "centre-driven"])
@pytest.mark.parametrize("at_m", [None, 0.0])
def test_a_beam_in_any_mounting_follows_a_slow_base_and_bends_under_a_fast_one(ends, at_m):
    """Also with a mass where a clamp holds it."""
    stated = replace(BEAM, ends=ends, spot_x_m=0.07)
    hidden = e.Effects(added_mass=e.AddedMass(1e-3, at_m)) if at_m is not None else e.Effects()
    mounted = mounted_beam(stated, reduced_beam(stated, LAW, pieces=6, effects=hidden), LAW, hidden)
    assert transmissibility(mounted, 1.0) == pytest.approx(1.0, abs=2e-3)
    assert abs(transmissibility(mounted, 400.0) - 1) > 0.05


def test_what_a_structure_cannot_have_is_refused():
    with pytest.raises(ValueError, match="partial_debond: not on a beam"):
        refuse_effects("beam", e.Effects(partial_debond=e.PartialDebond("x", 0.1, 0.2)))
    with pytest.raises(ValueError, match="base_rocking: not on a shear-pair"):
        refuse_effects("shear-pair", e.Effects(base_rocking=e.BaseRocking(0.1)))
    with pytest.raises(ValueError, match="off the beam"):
        reduced_beam(replace(BEAM, spot_x_m=0.21), LAW)
