"""What a beam carries: an accelerometer that is stated."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from fitting.effects import CATALOGUE
from fitting.laws import LAWS
from fitting.specimen import PlacedMass
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small import displacement, nuisances_of, system_of
from fitting.structures.small_modes import small_modes

METAL = Face(1e-3, 70e9, 0.33, 2700.0)
LAW = LAWS["fractional-zener"](5e5, 2e7, 1e-4, 0.6)
BEAM = Beam(0.28, 0.007, "clamped-free", METAL, METAL, Core(0.15e-3, 0.49, 1000.0, LAW), pickup_m=0.28)
OMEGA = 2 * np.pi * np.linspace(5, 800, 200)


def read(beam):
    return displacement(system_of(beam, beam.parts()), OMEGA, LAW.modulus(OMEGA))


@pytest.mark.parametrize("force_m", [None, 0.1])
def test_a_stated_mass_is_the_effect_of_one_that_is_not(force_m):
    beam = replace(BEAM, force_m=force_m)
    bare = system_of(beam, beam.parts())
    made = CATALOGUE["added_mass"].on("beam").change(bare, np.array([1.5e-3, 0.2]))
    load = bare.load if force_m is not None else bare.load + made.load
    expected = displacement(replace(bare, M=bare.M + made.M, load=load), OMEGA, LAW.modulus(OMEGA))
    np.testing.assert_allclose(
        read(replace(beam, masses=(PlacedMass(1.5e-3, 0.2, 0.0),))), expected, rtol=1e-6
    )


@pytest.mark.parametrize(("share", "within"), [(0.05, 2e-4), (0.3, 5e-4), (1.0, 1e-3)])
def test_a_cantilever_with_a_mass_at_its_tip(share, within):
    """Euler and Bernoulli: 1 + cos b cosh b = mu b (sin b cosh b - cos b sinh b), mu over the beam's mass."""
    bare = Beam(0.28, 0.007, "clamped-free", METAL, slender=True)
    whole = 2700.0 * 1e-3 * 0.007 * 0.28

    def characteristic(b):
        turning = np.sin(b) * np.cosh(b) - np.cos(b) * np.sinh(b)
        return 1 + np.cos(b) * np.cosh(b) - share * b * turning

    carrying = replace(bare, masses=(PlacedMass(share * whole, 0.28, 0.0),))
    found = [m.frequency_hz for m in small_modes(carrying, LAW, 3)]
    b = np.array([brentq(characteristic, *ends) for ends in ((0.5, 1.88), (3.0, 4.7), (6.0, 7.86))])
    flexural = np.sqrt(70e9 * (1e-3) ** 2 / 12 / 2700.0)
    np.testing.assert_allclose(found, b**2 / 0.28**2 * flexural / (2 * np.pi), rtol=within)


def test_it_is_known_as_well_as_its_balance_and_a_rule_say():
    carrying = replace(BEAM, masses=(PlacedMass(1.5e-3, 0.28, 0.0), PlacedMass(1e-3, 0.1, 0.0)))
    sigma = {n.name: n.sigma for n in nuisances_of(carrying, carrying.parts(), has_phase=True).each}
    assert [sigma[name] for name in ("mass", "place_1_x", "place_2_x")] == [0.02, 5e-4, 5e-4]
    assert carrying.stated_number("mass") == (2.5e-3, 1e3, "g")
    assert carrying.stated_number("place_2_x") == (0.1, 1e3, "mm")
    assert replace(carrying, exact=True).tolerance("mass") == 0.0


def test_twice_its_mass_is_twice_its_part():
    carrying = replace(BEAM, masses=(PlacedMass(1.5e-3, 0.28, 0.0),))
    heavier = system_of(carrying, carrying.parts(), {"mass": np.log(2.0)})
    twice = replace(BEAM, masses=(PlacedMass(3e-3, 0.28, 0.0),))
    np.testing.assert_allclose(heavier.M, system_of(twice, twice.parts()).M, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize(("boundary", "at_m"), [("clamped-free", 0.2), ("free-free", 0.21)])
@pytest.mark.parametrize("force_m", [None, 0.02])
def test_where_it_sits_is_a_number_of_its_own(boundary, at_m, force_m):
    """Beside nodes of its modes a millimetre changes some of them and not the others: no mass does that."""
    if force_m is None and boundary == "free-free":
        force_m = 0.1
    at, there = (
        replace(BEAM, boundary=boundary, force_m=force_m, masses=(PlacedMass(1.5e-3, x, 0.0),))
        for x in (at_m, at_m + 1e-3)
    )
    moved = displacement(system_of(at, at.parts(), {"place_1_x": 1e-3}), OMEGA, LAW.modulus(OMEGA))
    by_move = np.abs(read(there) - read(at)).max()
    assert np.abs(moved - read(there)).max() < 0.005 * by_move
