"""A beam whose core is uneven, beside pieces each as thick as it is, and beside a solid."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
from numpy.polynomial import Polynomial

from fitting.effects import CATALOGUE
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.beam_section import SLIP
from fitting.structures.beam_shapes import slip_by_pieces
from fitting.structures.beam_uneven import uneven
from fitting.structures.small import widened_system_of
from fitting.structures.small_modes import elastic_modes

ALUMINIUM, FOIL = Face(2e-3, 70e9, 0.3, 2700.0), Face(0.5e-3, 70e9, 0.3, 2700.0)
CORE = Core(0.3e-3, 0.49, 1000.0, ConstantModulus(1e6, 0.5))
SANDWICH = Beam(0.2, 0.02, "clamped-free", ALUMINIUM, constraining=FOIL, core=CORE, pickup_m=0.15)


@pytest.mark.parametrize("shape", [Polynomial((-0.5, 1)), Polynomial((-2 / 3, 4, -4))])
def test_a_core_of_uneven_thickness_is_that_of_pieces_each_as_thick_as_it_is(shape):
    beam = replace(SANDWICH, slender=True)
    pieces, size = slip_by_pieces(beam.section.ends, beam.section.arms), 0.3

    def slip(core):
        return np.array(replace(beam, core=core).section.coefficients[SLIP])

    plain = slip(beam.core)
    made = sum(
        np.tensordot(
            slip(replace(beam.core, thickness_m=beam.core.thickness_m * (1 + size * shape(s)))) - plain,
            piece,
            axes=1,
        )
        for s, piece in zip((np.arange(len(pieces)) + 0.5) / len(pieces), pieces, strict=True)
    )
    of = uneven(beam.section, shape)
    found = size * of["K_1"] + sum(size**n * of[f"inverse_{n}"] for n in (1, 2, 3))
    assert np.abs(found - made).max() < 0.01 * np.abs(made).max()


EVEN_HZ = (36.2900, 158.2825, 393.5059, 741.3530)
UNEVEN_HZ = {
    "bow": (35.7631, 160.5455, 394.1628, 741.8935),
    "wedge": (35.4335, 157.8741, 393.0779, 740.9759),
}
"""Of a solid of bricks (cubic along it, quadratic across, its width free at the clamp): 240 by 25 mm,
aluminium of 1.5 mm on either side of 0.8 mm whose G is 1 MPa; bow and wedge 0.24."""


@pytest.mark.parametrize("shape", UNEVEN_HZ)
def test_an_uneven_core_moves_modes_as_those_of_a_solid(shape):
    face = Face(1.5e-3, 70e9, 0.33, 2700.0)
    core = Core(0.8e-3, 0.49, 1000.0, ConstantModulus(1e6, 0.0))
    beam = Beam(0.24, 0.025, "clamped-free", face, constraining=face, core=core, pickup_m=0.22)
    effect = next(
        e for e in CATALOGUE["graded_core"].standing_on(beam).variants() if shape in e.spans[0].name
    )
    plate = widened_system_of(beam, beam.parts()).take(effect.spans)
    change = effect.change(plate, np.array([0.24]))
    uneven_one = replace(plate, K_0=plate.K_0 + change.K, K_1=plate.K_1 + change.K_1, M=plate.M + change.M)
    law = ConstantModulus(1e6, 0.0)
    even, found = (
        np.array([m.frequency_hz for m in elastic_modes(one, law, 4)]) for one in (plate, uneven_one)
    )
    assert found / even - 1 == pytest.approx(np.array(UNEVEN_HZ[shape]) / EVEN_HZ - 1, abs=6e-4)


@pytest.mark.parametrize(("k", "delta"), [(1, Polynomial((-0.5, 1))), (2, Polynomial((-2 / 3, 4, -4)))])
def test_a_shaken_base_pulls_at_an_uneven_core_where_its_mass_is(k, delta):
    beam = replace(SANDWICH, slender=True)
    effect = CATALOGUE["graded_core"].standing_on(beam).variants()[k]
    plate = widened_system_of(beam, beam.parts()).take(effect.spans)
    found = effect.change(plate, np.array([0.2])).load
    s = (np.arange(400) + 0.5) / 400
    per_piece = CORE.density_kg_m3 * CORE.thickness_m * beam.width_m * beam.length_m / len(s)
    rows = np.array([plate.row(beam.length_m * at, 0.0) for at in s])
    expected = -0.2 * per_piece * delta(s) @ rows
    assert np.abs(found - expected).max() < 0.01 * np.abs(expected).max()


@pytest.mark.parametrize("k", [1, 2])
def test_an_uneven_core_does_not_keep_a_free_beam_from_turning(k):
    free = replace(SANDWICH, boundary="free-free", force_m=0.02)
    effect = CATALOGUE["graded_core"].standing_on(free).variants()[k]
    plate = widened_system_of(free, free.parts()).take(effect.spans)
    change = effect.change(plate, np.array([0.2]))
    K = plate.K_0.real + change.K + 1e6 * (plate.K_1 + change.K_1)
    turned = la.eigvalsh(K, plate.M + change.M, subset_by_index=[0, 3])
    assert np.abs(turned[:3]).max() < 1e-4 * turned[3]
    assert not np.any(change.load)


def test_an_uneven_core_says_where_it_is_thicker():
    straight, wedge, bow = CATALOGUE["graded_core"].standing_on(SANDWICH).variants()
    assert bow.story({"bow": 0.3}) == "the core is 30 % thicker in the middle of the beam than at its ends"
    assert (
        wedge.story({"wedge": -0.3}) == "the core is 30 % thinner at the beam's far end than at its near one"
    )
    # 1.7 and 0.3 of the modulus in the middle: no modulus is negative.
    assert straight.story({"grade_x": -1.4}) == (
        "the core's modulus is 5.67 times as large at the beam's root as at its tip"
    )
