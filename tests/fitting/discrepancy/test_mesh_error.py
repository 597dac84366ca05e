"""What a mesh gets wrong, by a wave on endless elements: modes of whole plates are off by as much."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.discrepancy.layer_theory import layerwise_lambda
from fitting.discrepancy.mesh_error import beside_edges, fine_enough, mesh_error
from fitting.discrepancy.model_error import FREQUENCY, model_error_at
from fitting.dynamics.complex_modes import complex_modes
from fitting.laws.constant import ConstantModulus
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face, Glue, Orthotropy

ALUMINIUM = Face(2e-3, 70e9, 0.3, 2700.0)
FOIL = Face(0.5e-3, 70e9, 0.3, 2700.0)
SIDE = 0.3
WITHIN = 0.1
"""Of the error: what goes with the fourth power of elements this coarse."""


def square(G=2e6, elements=(12, 12), core=True, **more):
    law = ConstantModulus(G, 0.5)
    layers = (ALUMINIUM, FOIL, Core(1e-3, 0.45, 1000.0, law)) if core else (ALUMINIUM,)
    return PlateSpecimen(SIDE, SIDE, "simply-supported", *layers, elements=elements, **more), law


def off(plate, law):
    """Frequency and loss factor of the mode of one half wave each way over the theory's, less one."""
    k = np.array([np.sqrt(2) * np.pi / SIDE])
    (mode,) = (
        complex_modes(Plate(plate), law, 1)
        if plate.core is not None
        else complex_modes(Plate(plate), None, 1)
    )
    G = (
        law.modulus(np.array([2 * np.pi * mode.frequency_hz]))
        if plate.core is not None
        else np.zeros(1, complex)
    )
    theory = complex(layerwise_lambda(plate, k, G)[0])
    f = mode.frequency_hz / (np.sqrt(theory.real) / (2 * np.pi)) - 1
    eta = mode.loss_factor / (theory.imag / theory.real) - 1 if theory.imag else 0.0
    return k, G, f, eta


def at_45(found):
    """Of a wave between both axes: the mean is of the two extremes, one of them there."""
    return found.frequency[0] + np.sqrt(2) * found.frequency_by_way[0] * np.array([-1, 1])


@pytest.mark.parametrize("G", [2e4, 2e6, 2e8])
def test_a_mode_is_off_as_the_wave_says(G):
    plate, law = square(G)
    k, G, f, eta = off(plate, law)
    found = mesh_error(plate, k, G)
    assert np.abs(at_45(found) / f - 1).min() < WITHIN
    assert eta == pytest.approx(found.loss[0], abs=2 * found.loss_by_way[0] + 1e-5)


def test_a_bare_plate_s_deflection_is_too_soft():
    plate, law = square(core=False)
    k, G, f, _ = off(plate, law)
    assert f < 0
    assert np.abs(at_45(mesh_error(plate, k, G)) / f - 1).min() < WITHIN


def test_it_goes_with_the_square_of_an_element():
    k, G = np.array([30.0]), np.array([2e6 + 1e6j])
    coarse, fine = (mesh_error(square(elements=(n, n))[0], k, G) for n in (12, 24))
    assert coarse.frequency[0] == pytest.approx(4 * fine.frequency[0], rel=WITHIN)
    assert coarse.loss[0] == pytest.approx(4 * fine.loss[0], rel=WITHIN)


def test_every_kind_of_plate_has_one():
    k, G = np.array([15.0, 30.0]), np.array([2e6 + 1e6j] * 2)
    plate, _ = square()
    glue = replace(plate.core, glue=(Glue(5e-5, 1e9, 1200.0),))
    rolled = replace(ALUMINIUM, rolled=Orthotropy(66e9, 25e9, 0.3))
    of_plain = mesh_error(plate, k, G).frequency
    for other in (
        replace(plate, core=glue),
        replace(plate, substrate=rolled),
        replace(plate, both_sides=True),
        replace(plate, boundary="clamped-free-free-free"),
    ):
        found = mesh_error(other, k, G)
        assert np.all(np.isfinite(found.frequency))
        assert np.all(np.abs(found.frequency) < 10 * np.abs(of_plain).max())


def test_a_fit_counts_it():
    f, G = np.array([400.0]), np.array([2e6 + 1e6j])
    coarse, fine = (model_error_at(square(elements=(n, n))[0], f, G) for n in (12, 48))
    assert coarse.frequency[0] > 2 * fine.frequency[0] > 2 * FREQUENCY
    assert coarse.signed[0][0] != pytest.approx(fine.signed[0][0], rel=0.1)


@pytest.mark.parametrize("G", [2e6, 4e8])
def test_edges_of_a_stiff_core_are_counted_as_they_are(G):
    plate, law = square(G, (20, 20))
    plate = replace(
        plate,
        boundary="clamped-free-free-free",
        substrate=replace(ALUMINIUM, thickness_m=0.35e-3),
        constraining=replace(FOIL, thickness_m=0.25e-3),
        core=replace(plate.core, thickness_m=3.8e-3),
    )
    coarse, fine = (
        np.array([m.frequency_hz for m in complex_modes(Plate(replace(plate, elements=(n, n))), law, 4)])
        for n in (20, 40)
    )
    off = 4 / 3 * np.sqrt(np.mean((coarse / fine - 1) ** 2))
    said = model_error_at(plate, coarse, law.modulus(2 * np.pi * coarse))
    plain = model_error_at(plate, coarse, law.modulus(2 * np.pi * coarse), of_mesh=False)
    assert off < 2 * np.sqrt(np.mean(said.frequency**2 - plain.frequency**2 + FREQUENCY**2))
    if G > 1e8:
        assert off > FREQUENCY
        assert np.all(said.frequency**2 > plain.frequency**2 + FREQUENCY**2)


def test_a_stiff_core_asks_for_smaller_elements(zn1):
    assert fine_enough(zn1, 1e6) is None
    assert fine_enough(zn1.bare, 1e6) is None
    n_x, n_y = zn1.mesh
    assert fine_enough(zn1, 1e12) == (1.5 * n_x, 1.5 * n_y)
    some = next(m for m in np.geomspace(1e6, 1e12, 61) if fine_enough(zn1, m) is not None)
    assert fine_enough(zn1, some)[0] <= 1.15 * n_x


def test_what_is_left_beside_edges_is_less_where_a_coarser_mesh_tells(zn1):
    G = np.array([1e6, 1e10], complex)
    whole, left = beside_edges(zn1, G), beside_edges(zn1, G, taken_off=True)
    for all_of_it, rest in zip(whole, left, strict=True):
        assert rest[0] < 0.1 * all_of_it[0]
        assert rest[1] > 0.5 * all_of_it[1]
