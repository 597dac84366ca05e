"""Layers that are not what is stated: reduced plate beside full solves."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.sparse as sp

from fitting.dynamics.damping import viscous_damping
from fitting.effects import CATALOGUE
from fitting.effects.clamp_line import ClampLineEffect
from fitting.effects.constraining_stiffness import ConstrainingStiffnessEffect
from fitting.effects.constraining_thickness import ConstrainingThicknessEffect, with_layer
from fitting.effects.core_thickness import CoreThicknessEffect, with_core
from fitting.effects.graded_core import GradedCoreEffect
from fitting.effects.layer_density import CONSTRAINING, SUBSTRATE, LayerDensityEffect, with_density
from fitting.effects.orthotropic_substrate import sheet
from fitting.effects.substrate_stiffness import SubstrateStiffnessEffect
from fitting.effects.substrate_thickness import SubstrateThicknessEffect, with_substrate
from fitting.plate.element import (
    DOFS,
    THETA_Y,
    U_B,
    V_B,
    Shape,
    core_shear,
    face_plane_stress,
    face_stiffness,
)
from fitting.plate.plate import Plate
from fitting.stated.layers import Face
from fitting.widened.other_plates import changed_to, mixed

ORTHOTROPIC, GRADED = CATALOGUE["orthotropic_substrate"], CATALOGUE["graded_core"]
STIFFNESS, THICKNESS = ConstrainingStiffnessEffect(), ConstrainingThicknessEffect()
LENGTH = ClampLineEffect()
DENSITY, SHEET = LayerDensityEffect(), SubstrateThicknessEffect()


def test_one_modulus_both_ways_is_the_plain_substrate(full):
    shape, face = Shape(*full.loose.mesh.sides_m), full.specimen.substrate
    mine = face_stiffness(shape, sheet(face, 1.0), U_B, V_B)
    plain = face_stiffness(shape, face, U_B, V_B)
    assert np.abs(mine - plain).max() < 1e-12 * np.abs(plain).max()


def test_stiffness_of_an_orthotropic_sheet():
    """Compliance: E_x and E_y in tension, Poisson's ratio nu along x, its mirror in the ratio of moduli."""
    face = Face(1e-3, 70e9, 0.3, 2700.0)
    S = np.linalg.inv(face_plane_stress(sheet(face, 1.1)))
    assert 1 / S[0, 0] == pytest.approx(70e9)
    assert 1 / S[1, 1] == pytest.approx(77e9)
    assert -S[1, 0] / S[0, 0] == pytest.approx(0.3)
    assert 1 / S[2, 2] == pytest.approx(np.sqrt(1.1) * 70e9 / 2.6)


def test_the_stated_modulus_of_a_rolled_sheet_is_along_across_or_the_mean():
    face = Face(1e-3, 70e9, 0.3, 2700.0)
    for stated, young in (
        (0.0, (70e9, 77e9)),
        (0.5, np.array([1 / 1.1, 1.1]) ** 0.5 * 70e9),
        (1.0, (70e9 / 1.1, 70e9)),
    ):
        S = np.linalg.inv(face_plane_stress(sheet(face, 1.1, stated)))
        assert 1 / np.diag(S)[:2] == pytest.approx(young)


@pytest.mark.parametrize(("ratio", "stated"), [(0.8, 0), (0.97, 0), (1.1, 0), (1.3, 0), (1.1, 0.5), (0.9, 1)])
def test_a_rolled_sheet_answers_as_the_full_model_with_its_stiffness(full, ratio, stated):
    shape, face = Shape(*full.loose.mesh.sides_m), full.specimen.substrate
    other, plain = (face_stiffness(shape, f, U_B, V_B) for f in (sheet(face, ratio, stated), face))
    Ke = other - plain
    assert full.error(ORTHOTROPIC, [ratio, stated], K=full.loose.scatter(Ke)) < 5e-4


def graded(full, along, grade):
    """The core's shear with the modulus of every Gauss point."""
    s, mesh = full.specimen, full.loose.mesh
    a, b = mesh.sides_m
    shape = Shape(a, b)
    t, weight = np.polynomial.legendre.leggauss(4)
    flat, tilted = np.zeros((4 * DOFS, 4 * DOFS)), np.zeros((4 * DOFS, 4 * DOFS))
    for tx, wx in zip(t, weight, strict=True):
        for ty, wy in zip(t, weight, strict=True):
            N = core_shear(shape, s.core, s.substrate, s.constraining, a * (tx + 1) / 2, b * (ty + 1) / 2)
            Ke = s.core.thickness_m * a * b / 4 * wx * wy * sum(np.outer(n, n) for n in N)
            flat += Ke
            tilted += ((tx if along == "x" else ty) + 1) / 2 * Ke
    i, j = np.divmod(np.arange(mesh.n_x * mesh.n_y), mesh.n_y)
    place, count = (i, mesh.n_x) if along == "x" else (j, mesh.n_y)
    total = sp.csc_array((full.loose.size, full.loose.size))
    for k in range(count):
        Ke = grade * ((k / count - 0.5) * flat + tilted / count)
        total = total + full.loose.scatter(Ke, np.flatnonzero(place == k))
    return total


@pytest.mark.parametrize(("along", "grade"), [("x", 0.3), ("x", -1.2), ("y", 0.4), ("y", 1.3)])
def test_a_graded_core_answers_as_the_full_model(full, along, grade):
    assert full.error(GradedCoreEffect(along), [grade], K_1=graded(full, along, grade)) < 1e-3


@pytest.mark.parametrize("scale", [0.8, 1.06])
def test_a_stiffer_constraining_layer(full, scale):
    K = (scale - 1) * full.loose.K_constraining
    assert full.error(STIFFNESS, [scale], K=K) < 5e-4


@pytest.mark.parametrize("scale", [0.8, 0.94, 1.25])
def test_another_constraining_layer_answers_as_a_plate_built_with_it(full, scale):
    layer = full.specimen.constraining
    other = replace(full.specimen, constraining=replace(layer, thickness_m=scale * layer.thickness_m))
    assert full.error(THICKNESS, [scale], loose=Plate(replace(other, boundary="free"))) < 5e-4


@pytest.mark.parametrize("scale", [0.75, 0.94, 1.35])
def test_another_substrate_answers_as_a_plate_built_with_it(full, scale):
    other = with_substrate(full.specimen, scale)
    assert full.error(SHEET, [scale], loose=Plate(replace(other, boundary="free"))) < 5e-4


@pytest.mark.parametrize("scale", [0.5, 2.0])
@pytest.mark.parametrize(
    ("effect", "other"), [(THICKNESS, with_layer), (CoreThicknessEffect(), with_core)], ids=["foil", "core"]
)
def test_a_thickness_mistyped_by_a_factor_of_two(full, effect, other, scale):
    loose = Plate(replace(other(full.specimen, scale), boundary="free"))
    assert full.error(effect, [scale], loose=loose) < 5e-4


@pytest.mark.parametrize("scale", [0.5, 2.0])
def test_a_modulus_mistyped_by_a_factor_of_two(full, scale):
    for effect, K in (
        (SubstrateStiffnessEffect(), full.loose.K_substrate),
        (STIFFNESS, full.loose.K_constraining),
    ):
        assert full.error(effect, [scale], K=(scale - 1) * K) < 5e-4


@pytest.mark.parametrize("layer", [SUBSTRATE, CONSTRAINING])
@pytest.mark.parametrize("scale", [0.34, 0.95, 1.2, 2.9])
def test_another_density_answers_as_a_plate_built_with_it(full, layer, scale):
    """From steel to aluminium and back, damped by the same ratios."""
    other = with_density(full.specimen, scale, layer)
    damping = viscous_damping(Plate(other))
    U = (full.full.lift @ damping.U) * np.sqrt(damping.d / full.damping.d)
    loose = Plate(replace(other, boundary="free"))
    assert full.error(DENSITY, [scale, layer], loose=loose, U=U) < 1e-4


def test_what_the_struck_bare_plate_feels_is_what_the_substrate_is():
    bare = SimpleNamespace(lowering_per_density=np.zeros(3))
    assert DENSITY.bare_shift(bare, np.array([1.21, SUBSTRATE])) == pytest.approx(-np.log(1.1))
    assert DENSITY.bare_shift(bare, np.array([1.21, CONSTRAINING])) == pytest.approx(0.0)
    assert SHEET.bare_shift(bare, np.array([1.1])) == pytest.approx(np.log(1.1))


def test_another_plate_differs_in_the_parts_that_it_changes(full):
    change = changed_to(full.spanned, with_layer(full.specimen, 1.1))
    assert all(np.any(part) for part in (change.K, change.K_1, change.M, change.load))
    same = changed_to(full.spanned, full.specimen)
    assert not any(np.any(part) for part in (same.K, same.K_1, same.M, same.load))


def test_parts_are_mixed_and_real_ones_stay_so():
    parts = np.arange(12.0).reshape(3, 2, 2)
    assert np.array_equal(mixed(np.array([2.0, 0.0, -1.0]), parts), 2 * parts[0] - parts[2])
    assert np.isrealobj(mixed(np.array([2.0 + 0j, 0, 0]), parts))
    assert np.array_equal(mixed(np.array([0, 1j, 0]), parts), 1j * parts[1])


@pytest.mark.parametrize("too", [0.0, 1.0])
@pytest.mark.parametrize("dlength", [-7e-3, -2e-3, 4e-3])
def test_another_free_length_answers_as_a_plate_built_with_it(full, dlength, too):
    length = full.specimen.length_m + dlength
    other = Plate(replace(full.specimen, length_m=length, boundary="free"))
    # The stated plate's damping, taken over with its stretched shapes.
    U = (full.full.lift @ full.damping.U).reshape(-1, DOFS, len(full.damping.d)).copy()
    U[:, THETA_Y] *= length / full.specimen.length_m
    U = U.reshape(full.loose.size, -1)
    x, y = full.full.pickup_m
    row = other.observe(x + too * dlength, y)
    assert full.error(LENGTH, [dlength, too], loose=other, U=U, row=row) < 3e-4


def _all(effect, first):
    """All unknowns of an effect, zero after the first."""
    return [first, *(0.0 for _ in effect.parameters[1:])]


@pytest.mark.parametrize(
    ("effect", "neutral"),
    [(ORTHOTROPIC, 1), (GRADED, 0), (STIFFNESS, 1), (THICKNESS, 1), (LENGTH, 0), (DENSITY, 1), (SHEET, 1)],
)
def test_without_it_nothing_changes(full, effect, neutral):
    assert effect.parameters[0].neutral == neutral
    assert full.error(effect, _all(effect, neutral)) < 1e-5


@pytest.mark.parametrize(
    ("effect", "at"),
    [
        *((ORTHOTROPIC, 1.0), (GRADED, 0.0), (STIFFNESS, 1.0), (THICKNESS, 1.05), (LENGTH, 1e-3)),
        *((DENSITY, 1.1), (SHEET, 1.05)),
    ],
)
def test_derivatives_of_the_layers_effects_are_those_of_differences(full, effect, at):
    by, difference = full.slope(effect, _all(effect, at), 0)
    assert np.abs(by / difference - 1).max() < 1e-4
