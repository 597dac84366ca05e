"""A sensor that sits on a beam and is not stated."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.laws import LAWS
from fitting.specimen import PlacedMass
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small import displacement, system_of
from fitting.sweep import Sweep
from instrument.mistakes.quick_look import data_doubt
from instrument.mistakes.unstated_mass import mass_kg

METAL = Face(1e-3, 70e9, 0.33, 2700.0)
LAW = LAWS["fractional-zener"](5e5, 2e7, 1e-4, 0.6)
BEAM = Beam(0.28, 0.007, "clamped-free", METAL, METAL, Core(0.15e-3, 0.49, 1000.0, LAW), pickup_m=0.28)
F = np.geomspace(8, 700, 160)


def sweep_of(beam):
    omega = 2 * np.pi * F
    v = 9.81j * omega * displacement(system_of(beam, beam.parts()), omega, LAW.modulus(omega))
    ones = np.ones(len(F), dtype=int)
    return Sweep(F, v, np.full(len(F), 9.81), segment=ones, sweep=ones)


@pytest.mark.parametrize("share", [0.1, 0.25])
def test_what_a_sensor_of_that_mass_explains_is_said_to_be_one(share):
    m = share * mass_kg(BEAM)
    carrying = replace(BEAM, masses=(PlacedMass(m, 0.28, 0.0),))
    said = data_doubt(sweep_of(carrying), BEAM)
    assert "g sat at the pickup that are not stated: [[mass]]" in said
    # The window says the same, and has no options.
    assert "--" not in said
    assert float(said.split("some ")[1].split(" g")[0]) == pytest.approx(1e3 * m, rel=0.35)
    assert data_doubt(sweep_of(carrying), carrying) == ""


def test_nothing_is_asked_of_a_beam_that_carries_none():
    assert data_doubt(sweep_of(BEAM), BEAM) == ""


def test_a_beams_mass_is_that_of_its_layers():
    assert mass_kg(BEAM) == pytest.approx(0.28 * 0.007 * (2 * 2.7 + 0.15))
    assert mass_kg(replace(BEAM, both_sides=True)) == pytest.approx(0.28 * 0.007 * (3 * 2.7 + 2 * 0.15))
