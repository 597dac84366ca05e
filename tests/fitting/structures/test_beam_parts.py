"""What a beam's matrices have beside its own modes."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la

from fitting.effects import CATALOGUE
from fitting.effects.treatment_not_gripped import LetGo
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.beam_parts import parts_of
from fitting.structures.small import displacement, system_of, widened_system_of
from fitting.structures.small_modes import elastic_modes, small_modes

ALUMINIUM, FOIL = Face(2e-3, 70e9, 0.3, 2700.0), Face(0.5e-3, 70e9, 0.3, 2700.0)
CORE = Core(0.3e-3, 0.49, 1000.0, ConstantModulus(1e6, 0.5))
SANDWICH = Beam(0.2, 0.02, "clamped-free", ALUMINIUM, constraining=FOIL, core=CORE, pickup_m=0.15)
OBERST = Beam(0.2, 0.02, "clamped-free", ALUMINIUM, core=CORE, pickup_m=0.15)


def test_columns_of_effects_stand_apart_from_its_own():
    wide = widened_system_of(SANDWICH, SANDWICH.parts())
    assert set(wide.group) == {"plate", "faces", "root", "treatment", "uneven_wedge", "uneven_bow"}
    assert set(system_of(SANDWICH, SANDWICH.parts()).group) == {"plate"}
    free = replace(SANDWICH, boundary="free-free", force_m=0.02)
    assert set(widened_system_of(free, free.parts()).group) == {
        "plate",
        "faces",
        "uneven_wedge",
        "uneven_bow",
    }


def test_between_nodes_the_deflection_is_the_polynomials_own():
    plate = system_of(SANDWICH, SANDWICH.parts())
    assert plate.row(0.15, 0.0) == pytest.approx(
        plate.observe, rel=1e-6, abs=1e-6 * np.abs(plate.observe).max()
    )
    h = 1e-6
    slope = (plate.row(0.09 + h, 0.01) - plate.row(0.09 - h, 0.01)) / (2 * h)
    assert plate.row(0.09, 0.01, dx=1) == pytest.approx(slope, rel=1e-5, abs=1e-5 * np.abs(slope).max())


def test_strips_add_up_to_the_core_s_shear_and_a_grade_leaves_the_middle():
    # What a width adds to the core's shear, half a percent, comes loose in no strip.
    beam = replace(SANDWICH, slender=True)
    spans = [CATALOGUE[n].standing_on(beam).spans[0] for n in ("partial_debond", "graded_core")]
    wide = widened_system_of(beam, beam.parts()).take(spans)
    strips, whole = wide.stack("strips_x."), wide.K_1
    assert np.allclose(strips.sum(axis=0), whole, rtol=0, atol=1e-9 * np.abs(whole).max())
    middles = (np.arange(len(strips)) + 0.5) / len(strips) - 0.5
    _, modes = la.eigh(wide.K_0.real + 1e6 * wide.K_1, wide.M, subset_by_index=[0, 2])
    graded, tilted = (
        np.diag(modes.T @ A @ modes)
        for A in (np.tensordot(middles, strips, axes=1), wide.matrix("grading_x.K_1"))
    )
    assert graded == pytest.approx(tilted, rel=5e-3)


def test_a_turning_base_bends_a_stiff_beam_as_its_distances_do():
    bare = Beam(0.2, 0.02, "clamped-free", ALUMINIUM, pickup_m=0.2, slender=True)
    system = system_of(bare, bare.parts())
    turned = displacement(replace(system, load=system.pitch), np.array([1.0]), np.zeros(1, complex))[0]
    per_length, rigidity = 2700 * 2e-3 * 0.02, 70e9 * 0.02 * 2e-3**3 / 12
    # A cantilever under a load that grows from its root: 11 q L^4/120.
    assert turned.real == pytest.approx(-11 / 120 * per_length * 0.2 * 0.2**4 / rigidity, rel=1e-4)


def test_a_layer_let_go_at_the_root_carries_no_tension_there():
    wide = widened_system_of(SANDWICH, SANDWICH.parts())
    found = []
    for k in (0.0, 1e14):
        plate = wide.take([LetGo()])
        held = replace(plate, K_0=plate.K_0 + k * plate.matrix("treatment.hold"))
        found.append(displacement(held, np.array([60.0]), np.array([1e6 + 5e5j]))[0])
    own = displacement(system_of(SANDWICH, SANDWICH.parts()), np.array([60.0]), np.array([1e6 + 5e5j]))[0]
    assert found[1] == pytest.approx(own, rel=1e-4)
    assert abs(found[0]) > 1.2 * abs(own)


def test_a_force_loads_it_where_it_acts_and_a_base_everywhere():
    section = SANDWICH.section
    struck, shaken = parts_of(section, 0.75, 0.4), parts_of(section, 0.75, None)
    plate = system_of(replace(SANDWICH, force_m=0.08), replace(SANDWICH, force_m=0.08).parts())
    assert plate.load == pytest.approx(plate.row(0.08, 0.0), rel=1e-5, abs=1e-5 * np.abs(plate.load).max())
    assert not np.allclose(struck.load, shaken.load)


def test_what_a_force_here_moves_there_is_what_one_there_moves_here():
    omega, G = 2 * np.pi * np.geomspace(10, 1000, 9), np.full(9, 1e6 + 5e5j)
    one, other = (replace(SANDWICH, force_m=a, pickup_m=b) for a, b in ((0.05, 0.18), (0.18, 0.05)))
    a, b = (displacement(system_of(s, s.parts()), omega, G) for s in (one, other))
    assert a == pytest.approx(b, rel=1e-9)


@pytest.mark.parametrize("beam", [SANDWICH, OBERST], ids=["sandwich", "oberst"])
def test_a_free_beam_below_its_modes_is_a_rigid_body(beam):
    # Of a rod: its sections' own turning is left out.
    free = replace(beam, boundary="free-free", force_m=0.02, pickup_m=0.15, slender=True)
    omega = np.array([2 * np.pi * 0.5])
    x = displacement(system_of(free, free.parts()), omega, np.array([1e6 + 5e5j]))[0]
    layers = (s for s in (free.substrate, free.constraining, free.core) if s is not None)
    mass = sum(s.thickness_m * s.density_kg_m3 for s in layers) * free.width_m * free.length_m
    a, b = 0.02 - 0.1, 0.15 - 0.1
    expected = -(1 + 12 * a * b / 0.2**2) / (mass * omega[0] ** 2)
    assert x.real == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("length_m", [0.2, 0.4])
def test_faces_of_another_stiffness_stretch_apart(length_m):
    """Their own columns hold them in the proportion that the stated ones have: 0.7 % off in f, before.

    How far from a clamp they part depends on their stiffness too: 1.2e-5 of the fourth mode.
    """
    stated = replace(SANDWICH, length_m=length_m, constraining=ALUMINIUM)
    stiffer = replace(ALUMINIUM, young_pa=1.35 * ALUMINIUM.young_pa)
    expected = [m.frequency_hz for m in small_modes(replace(stated, substrate=stiffer), CORE.law, 4)]
    effect = CATALOGUE["substrate_stiffness"].standing_on(stated)
    plate = widened_system_of(stated, stated.parts()).take(effect.spans)
    change = effect.change(plate, np.array([1.35]))
    changed = replace(plate, K_0=plate.K_0 + change.K, K_1=plate.K_1 + change.K_1, M=plate.M + change.M)
    assert [m.frequency_hz for m in elastic_modes(changed, CORE.law, 4)] == pytest.approx(expected, rel=2e-5)


def test_air_that_goes_along_drives_a_beam_whose_base_moves_and_no_other():
    struck = replace(SANDWICH, force_m=0.05)
    shaken, still = (widened_system_of(b, b.parts()).vector("air.load") for b in (SANDWICH, struck))
    assert np.any(shaken)
    assert not np.any(still)
