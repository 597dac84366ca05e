"""What a tether and softening are on a shear pair, beside closed forms."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from shear_pair_cases import LAW, pair, sweep

from fitting.dynamics.dynamic_stiffness import dynamic_stiffness
from fitting.effects import CATALOGUE
from fitting.laws import LAWS
from fitting.planning.unseen import unseen
from fitting.structures.small import widened_system_of
from instrument.finding.diagnosis import diagnose
from instrument.models.files import File

TOO_SOFT = LAWS["fractional-zener"](2.6e6, 80e6, 2.5e-5, 0.48)
"""A fit begins from this one, and not from the law that the sweeps are made of."""


def test_a_cable_at_the_mass_is_a_gain_and_a_stiffer_pad():
    """T = g K'/(K' - m omega^2) with K' = K + k and g = K/K': the base's pull is the pad's alone."""
    light = pair(0.5, gyration_m=None)
    plate = widened_system_of(light, light.parts()).take([])
    tether = CATALOGUE["tether"].standing_on(light)
    k, loss = 2e3, 0.3
    change = tether.change(plate, np.array([k, loss]))
    omega = 2 * np.pi * np.array([20.0, 60.0])
    G = LAW.modulus(omega)
    matrices = np.array([plate.K_0 + change.K, plate.K_1 + 0j, plate.M + 0j, np.zeros_like(plate.M) + 0j])
    A = dynamic_stiffness(matrices, omega, G)
    load = plate.load - np.outer(1 / omega**2, change.travel_load)
    relative = np.linalg.solve(A, load[:, :, None])[:, :, 0] @ plate.observe
    pad = G * light.discs * light.area_m2 / light.core.thickness_m
    # A third of the rubber's mass moves with the mass, and as much of its load is half of it.
    rubber = light.core.density_kg_m3 * light.discs * light.area_m2 * light.core.thickness_m
    both = pad + k * (1 + 1j * loss)
    absolute = (pad + omega**2 * rubber / 6) / (both - omega**2 * (light.mass_kg + rubber / 3))
    np.testing.assert_allclose(1 - omega**2 * relative, absolute, rtol=2e-3)
    assert "a cable pulls at the mass" in tether.story({"k": k, "loss_factor": loss})


@pytest.mark.parametrize("number", [1, 2])
def test_a_stiff_cord_at_one_of_three_masses_is_found_there(number):
    masses = (0.573, 0.311, 0.152)
    specimens = [replace(pair(m), core=replace(pair(m).core, law=TOO_SOFT)) for m in masses]
    stiffness = 4e4
    cords = [stiffness * (k == number) for k in (1, 2, 3)]
    given = [
        File(sweep(pair(m), cord_n_m=c, noise=5e-4, points=100, seed=k), s)
        for k, (m, c, s) in enumerate(zip(masses, cords, specimens, strict=True))
    ]
    (found,) = diagnose(given).result.effects
    assert found.name == "tether"
    assert found.parameters["file"].value == number
    k = found.parameters["k"]
    assert abs(k.value - stiffness) < 2 * k.standard_error < stiffness


def test_a_stronger_start_of_a_cord_loses_no_larger_share():
    tether = CATALOGUE["tether"].standing_on(pair(0.5))
    np.testing.assert_array_equal(tether.scaled(np.array([300.0, 0.2]), -20.0), [-6000.0, 0.2])


@pytest.mark.parametrize(("drive", "levels", "expected"), [("base", 1, True), ("base", 2, False)])
def test_softening_of_a_pad_passes_for_a_law_at_one_level(drive, levels, expected):
    softening = CATALOGUE["amplitude_softening"].standing_on(pair(0.5))
    points = SimpleNamespace(drive=drive, levels=levels, timed=False)
    assert softening.passes_for_a_law(points) is expected
    assert (softening.objection(points, None) is not None) is expected


def test_softening_at_one_level_is_listed_as_what_may_be_there_unseen():
    # Where the pads are measured well: otherwise what it does lies within the band.
    specimen = pair(0.573, edges=True, tolerances={"mass": 1e-3, "core_thickness": 1e-3, "area": 1e-3})
    given = [File(sweep(specimen, softening=10.0, seed=1, points=80), specimen)]
    others = [name for name in CATALOGUE if name != "amplitude_softening"]
    found = diagnose(given, without=others)
    assert found.result.verdict == "none"
    assert [one.name for one in unseen(found.result.rivals, found.effects)] == ["amplitude_softening"]
