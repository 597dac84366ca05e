"""A treatment that ends short of the clamp, against a solid of bricks that does."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.linalg import eigsh

from drivers.simulated.plant.layered_solid import Sheet
from drivers.simulated.plant.solid_beam import BeamBuild, BeamStated, SolidBeam
from fitting.effects.treatment_not_gripped import TreatmentEndsShortEffect, TreatmentOfBeamEffect
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.beam_let_go import hold_above
from fitting.structures.beam_strip import strip
from fitting.structures.small import widened_system_of
from fitting.structures.small_modes import elastic_modes

LAW = ConstantModulus(5e6, 0.01)
STEEL = Face(1.5e-3, 70e9, 0.3, 2700.0)
BEAM = Beam(
    *(0.22, 0.015, "clamped-free", STEEL, replace(STEEL, thickness_m=0.3e-3)),
    core=Core(0.2e-3, 0.49, 1000.0, LAW),
    pickup_m=0.22,
)


def of_solid(beam, gap_m=None):
    faces = [
        (f.thickness_m, f.young_pa, f.poisson, f.density_kg_m3) for f in (beam.substrate, beam.constraining)
    ]
    core = (beam.core.thickness_m, 2 * (1 + beam.core.poisson), beam.core.poisson, beam.core.density_kg_m3)
    sheets = tuple(Sheet(*s) for s in (faces[0], core, faces[1]))
    stated = BeamStated(beam.length_m, beam.width_m, beam.boundary, sheets, (1,), beam.length_m)
    gripped = None if gap_m is None else stated.heights_m(0)
    solid = SolidBeam(stated, 24, BeamBuild(gripped_m=gripped, treatment_from_m=gap_m))
    K, free = solid.face(0) + solid.face(2) + LAW.g_pa * solid.core, solid.free
    squared = eigsh(
        K[free][:, free].tocsc(), 6, solid.M[free][:, free].tocsc(), sigma=0, return_eigenvectors=False
    )
    return np.sqrt(np.sort(squared)) / (2 * np.pi)


def of_model(beam, gap_m=None):
    effect = TreatmentEndsShortEffect(2 if beam.boundary == "clamped-clamped" else 1)
    plate = widened_system_of(beam, beam.parts())
    if gap_m is None:
        return np.array([m.frequency_hz for m in elastic_modes(plate.take([]), LAW, 6)])
    plate = plate.take(effect.spans)
    change = effect.change(plate, np.array([gap_m]))
    short = replace(plate, K_0=plate.K_0 + change.K, K_1=plate.K_1 + change.K_1, M=plate.M + change.M)
    return np.array([m.frequency_hz for m in elastic_modes(short, LAW, 6)])


@pytest.mark.parametrize("gap_mm", [2.0, 8.0, 16.0])
@pytest.mark.parametrize("boundary", ["clamped-free", "clamped-clamped"])
def test_six_modes_fall_as_those_of_a_solid_do(boundary, gap_mm):
    beam = replace(BEAM, boundary=boundary, pickup_m=0.11)
    fallen, expected = (of(beam, gap_mm / 1e3) / of(beam) - 1 for of in (of_model, of_solid))
    assert expected[0] < -0.02
    np.testing.assert_allclose(fallen, expected, atol=0.004)


def test_one_as_thick_as_the_substrate_is_found_as_short_as_it_is():
    beam = replace(BEAM, constraining=STEEL, core=replace(BEAM.core, thickness_m=0.5e-3))
    expected = of_solid(beam, 8e-3) / of_solid(beam) - 1
    gaps = np.arange(7.0, 9.1, 0.25) / 1e3
    off = [np.abs(of_model(beam, g) / of_model(beam) - 1 - expected).max() for g in gaps]
    assert min(off) < 0.002
    assert gaps[np.argmin(off)] == pytest.approx(8e-3, abs=6e-4)


@pytest.mark.parametrize(("thick_mm", "softer"), [(0.3, -0.05), (1.5, -0.2)])
def test_one_that_ends_right_at_the_clamp_neither_slides_nor_bends_there(thick_mm, softer):
    above = replace(STEEL, thickness_m=thick_mm / 1e3)
    beam = replace(BEAM, constraining=above, core=replace(BEAM.core, thickness_m=0.5e-3))
    expected = of_solid(beam, 0.0) / of_solid(beam) - 1
    assert expected[0] < softer
    effect = TreatmentOfBeamEffect()
    plate = widened_system_of(beam, beam.parts()).take(effect.spans)
    for k, fallen in ((1.0, expected), (1e13, np.zeros(6))):
        let_go = replace(plate, K_0=plate.K_0 + effect.change(plate, np.array([k])).K)
        found = np.array([m.frequency_hz for m in elastic_modes(let_go, LAW, 6)])
        np.testing.assert_allclose(found / of_model(beam) - 1, fallen, atol=0.003)


def test_a_strip_without_length_holds_rigidly_and_a_force_bends_it_as_a_cantilever():
    section = BEAM.section
    # w and t at its end for a unit force there: g^3/(3 EI) and g^2/(2 EI).
    found, g, E_I = strip(section), 0.01, 70e9 * 0.015 * 1.5e-3**3 / 12
    s, L = section.shapes, section.length_m
    w, t = s.rows("w", np.zeros(1))[:, 0], s.rows("w", np.zeros(1), 1)[:, 0] / L
    V = np.linalg.pinv(np.array([w, t]))
    K = sum(V.T @ found[f"spring_{n}"] @ V / g**n for n in (1, 2, 3))
    np.testing.assert_allclose(np.linalg.solve(K, [1.0, 0.0]), [g**3 / 3 / E_I, g**2 / 2 / E_I], rtol=1e-6)


def test_what_holds_a_treatment_feels_its_end_alone():
    section = BEAM.section
    hold, s = hold_above(section), section.shapes
    assert np.all(hold[:, s.is_held] == 0)
    lifted = np.zeros(s.size)
    lifted[s.place["w"].start + np.flatnonzero(~s.is_held[s.place["w"]])[0]] = 1.0
    assert lifted @ hold @ lifted == pytest.approx(1.0)
