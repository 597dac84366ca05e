"""Plates that are not one treatment all over one side of an isotropic sheet: each beside something known."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.discrepancy.layer_theory import layerwise_lambda
from fitting.discrepancy.theory_error import check_theory, theory_error
from fitting.dynamics.real_modes import real_modes
from fitting.effects import CATALOGUE
from fitting.laws.constant import ConstantModulus
from fitting.nuisances.nuisances import Nuisances, nuisances_of
from fitting.plate.element import face_plane_stress
from fitting.plate.layers_array import layers_of, specimen_of
from fitting.plate.mesh import SHIFT_M
from fitting.plate.part_matrices import moving_part, projected_parts
from fitting.plate.part_names import names_of
from fitting.plate.parts import coefficients, loaded
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import plate_numbers
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face, Glue, Orthotropy
from fitting.stated.patches import Patch, shifts_of

G = 5e5
CORE = Core(0.5e-3, 0.49, 790.0, ConstantModulus(G, 0.8))
SHEET = Face(1.9e-3, 68.9e9, 0.3, 2700.0)
FOIL = Face(0.3e-3, 209e9, 0.3, 7890.0, 0.01)
PLATE = PlateSpecimen(0.3, 0.2, "cantilever", SHEET, FOIL, CORE, pickup_m=(0.06, 0.06), elements=(15, 10))
ROLLED = Orthotropy(30e9, 12e9)
GLUED = replace(CORE, glue=(Glue(30e-6, 3e6, 1100.0, 0.3), Glue(20e-6, 8e6, 1000.0)))
PATCHES = (Patch(0.0, 0.105, 0.031, 0.17), Patch(0.155, 0.26, 0.021, 0.09))
TURNED = replace(PLATE, substrate=replace(SHEET, rolled=replace(ROLLED, angle_rad=0.5)))
EVERYTHING = replace(TURNED, core=GLUED, both_sides=True, patches=PATCHES)


def frequencies(specimen, modulus=G, count=5):
    return real_modes(Plate(specimen), modulus, count).omega / (2 * np.pi)


def test_patches_that_cover_all_of_it_are_the_ordinary_plate():
    apart = (Patch(0, 0.13, 0, 0.2), Patch(0.13, 0.3, 0, 0.07), Patch(0.13, 0.3, 0.07, 0.2))
    for patches in ((Patch(0, 0.3, 0, 0.2),), apart):
        assert frequencies(replace(PLATE, patches=patches)) == pytest.approx(frequencies(PLATE), rel=1e-9)


def test_a_patch_that_covers_next_to_nothing_is_the_bare_plate():
    little = replace(PLATE, patches=(Patch(0.1, 0.1004, 0.0998, 0.1002),))
    # A bare plate in its clamp has the twist that free edges lack taken off afterwards, a struck one before.
    bare = replace(PLATE.bare, force_m=(0.29, 0.02))
    assert frequencies(little) == pytest.approx(frequencies(bare, 0.0), rel=1e-3)


def test_where_a_patch_ends_between_nodes_makes_no_step():
    f = [
        frequencies(replace(PLATE, patches=(Patch(0.0, end, 0, 0.2),)), count=3)
        for end in 0.16 + 2.5e-3 * np.arange(9)
    ]
    assert np.abs(np.diff(np.log(f), n=3, axis=0)).max() < 3e-5


def test_a_patch_does_not_depend_on_the_mesh():
    patched = replace(PLATE, patches=(Patch(0.0523, 0.2111, 0.03, 0.17),))
    fine = replace(patched, elements=(45, 30))
    assert frequencies(patched, count=4) == pytest.approx(frequencies(fine, count=4), rel=1.5e-3)


def test_turned_by_a_right_angle_the_axes_are_exchanged():
    turned = replace(SHEET, rolled=replace(ROLLED, angle_rad=np.pi / 2))
    ratio = ROLLED.young_y_pa / SHEET.young_pa
    exchanged = replace(
        SHEET,
        young_pa=ROLLED.young_y_pa,
        poisson=0.3 * ratio,
        rolled=Orthotropy(SHEET.young_pa, ROLLED.shear_pa),
    )
    a, b = (replace(PLATE, substrate=face) for face in (turned, exchanged))
    assert a.only_even
    assert frequencies(a) == pytest.approx(frequencies(b), rel=1e-9)


def test_an_isotropic_face_may_be_turned_as_one_likes():
    face = replace(SHEET, rolled=Orthotropy(SHEET.young_pa, SHEET.young_pa / 2.6, 0.7))
    struck = replace(PLATE, force_m=(0.2, 0.1))
    assert frequencies(replace(struck, substrate=face)) == pytest.approx(frequencies(struck), rel=1e-9)


def test_a_turn_to_either_side_is_the_same_plate_mirrored():
    other = replace(SHEET, rolled=replace(ROLLED, angle_rad=-0.5))
    assert not TURNED.only_even
    assert frequencies(TURNED) == pytest.approx(frequencies(replace(TURNED, substrate=other)), rel=1e-9)


def test_a_simply_supported_orthotropic_plate_is_the_closed_form():
    """omega^2 = pi^4/(rho h) (D_11 m^4/a^4 + 2 (D_12 + 2 D_66) m^2 n^2/(a b)^2 + D_22 n^4/b^4)."""
    face = replace(SHEET, rolled=ROLLED)
    plate = PlateSpecimen(0.3, 0.2, "simply-supported", face, elements=(36, 24))
    D = face_plane_stress(face) * face.thickness_m**3 / 12
    m, n = (np.arange(1, 6)[:, None] * np.pi / 0.3) ** 2, (np.arange(1, 6) * np.pi / 0.2) ** 2
    squared = D[0, 0] * m**2 + 2 * (D[0, 1] + 2 * D[2, 2]) * m * n + D[1, 1] * n**2
    exact = np.sort(np.sqrt(squared / (face.density_kg_m3 * face.thickness_m)).ravel())[:5] / (2 * np.pi)
    assert frequencies(plate, 0.0) == pytest.approx(exact, rel=3e-3)


def test_treated_on_both_sides_it_is_the_closed_form_of_five_layers():
    """D = D_b + 2 D_c + 2 A_c d^2 / (1 + A_c H k^2/G): the substrate's middle does not stretch."""
    thin = replace(CORE, thickness_m=0.05e-3, density_kg_m3=1.0)
    plate = PlateSpecimen(0.3, 0.2, "simply-supported", SHEET, FOIL, thin, both_sides=True, elements=(36, 24))
    k_2 = (np.pi / 0.3) ** 2 + (np.pi / 0.2) ** 2
    A, H = FOIL.young_pa / (1 - 0.3**2) * FOIL.thickness_m, thin.thickness_m
    bending = [f.young_pa / (1 - 0.3**2) * f.thickness_m**3 / 12 for f in (SHEET, FOIL)]
    mass = SHEET.density_kg_m3 * SHEET.thickness_m + 2 * FOIL.density_kg_m3 * FOIL.thickness_m
    for modulus in (2e4, G, 1e7):
        D = bending[0] + 2 * bending[1] + 2 * A * plate.apart_m**2 / (1 + A * H * k_2 / modulus)
        exact = np.sqrt(D * k_2**2 / mass) / (2 * np.pi)
        assert frequencies(plate, modulus, 1)[0] == pytest.approx(exact, rel=1.5e-3)


@pytest.mark.parametrize(
    "more", [{}, {"both_sides": True}, {"core": GLUED}, {"both_sides": True, "core": GLUED}]
)
def test_a_wave_theory_of_the_same_layers_agrees(more):
    plate = replace(PLATE, boundary="simply-supported", elements=(36, 24), **more)
    k = np.hypot(np.pi / 0.3, np.pi / 0.2)
    stiff = replace(
        plate, core=replace(plate.core, glue=tuple(replace(g, loss_factor=0) for g in plate.core.glue))
    )
    wave = np.sqrt(layerwise_lambda(stiff, k, G).real[0]) / (2 * np.pi)
    assert frequencies(stiff, count=1)[0] == pytest.approx(wave, rel=2e-3)


def test_stiff_glue_is_none():
    stiff = replace(CORE, glue=(Glue(1e-9, 1e12, 1100.0), Glue(1e-9, 1e12, 1100.0)))
    assert frequencies(replace(PLATE, core=stiff)) == pytest.approx(frequencies(PLATE), rel=1e-6)


def test_glue_as_soft_as_the_core_makes_it_thicker():
    thinner = replace(CORE, thickness_m=0.4e-3, glue=(Glue(0.1e-3, G, 790.0),))
    assert frequencies(replace(PLATE, core=thinner)) == pytest.approx(frequencies(PLATE), rel=1e-5)


@pytest.mark.parametrize(
    "specimen",
    [TURNED, replace(PLATE, core=GLUED), replace(PLATE, patches=PATCHES), EVERYTHING],
    ids=["turned", "glued", "patched", "everything"],
)
def test_parts_times_coefficients_are_the_plate(specimen):
    plate, c = Plate(specimen), coefficients(specimen, specimen)
    X = np.random.default_rng(0).normal(size=(plate.size, 2))
    at, parts = names_of(specimen).counts, projected_parts(plate, X)
    K_0, K_1, M = parts[at.K_0], parts[at.K_1], parts[at.M]
    twist = X.T @ (plate.edge_twist @ X) if specimen.lacks_edge_twist else 0.0
    for found, whole in (
        (np.tensordot(c.K_0, K_0, 1) - twist, plate.K_0),
        (np.tensordot(c.K_1, K_1, 1), plate.K_1),
        (np.tensordot(c.M, M, 1), plate.M),
    ):
        assert found == pytest.approx(X.T @ (whole @ X), rel=1e-9, abs=1e-12 * np.abs(found).max())
    load = -loaded(c.load, moving_part(specimen)[..., plate.free])
    assert load == pytest.approx(plate.base_load, rel=1e-9, abs=1e-15)


def test_what_is_kept_of_the_layers_brings_the_specimen_back():
    size = np.array([0.3, 0.2, 15, 10])
    c, kept = (coefficients(s, s) for s in (EVERYTHING, specimen_of(size, layers_of(EVERYTHING))))
    assert np.array_equal(c.all, kept.all)
    assert layers_of(PLATE).shape == (3, 5)


def stated(specimen):
    return Nuisances(
        specimen, tuple(n for n in nuisances_of(specimen, _Deaf(), has_phase=False).each if n.kind != "gain")
    )


class _Deaf:
    """A plate without viscous damping."""

    U, d = np.zeros((1, 0)), np.zeros(0)


def test_every_new_number_has_a_tolerance_and_moves_the_plate_as_the_other_plate_is():
    rolled = replace(FOIL, rolled=Orthotropy(190e9, 70e9, 0.2))
    specimen = replace(EVERYTHING, constraining=rolled, elements=(8, 6))
    numbers = stated(specimen)
    names = [n.name for n in numbers.each]
    assert {
        "substrate_young_y",
        "constraining_shear",
        "substrate_angle",
        "glue_shear",
        "glue_thickness",
    } < set(names)
    assert {"patch_1_x", "patch_1_y", "patch_2_x", "patch_2_y"} < set(names)
    # From the clamp to its other end the first one is as long as that end is laid.
    assert [n for n in names if n.startswith("cut")] == ["cut_1_y", "cut_2_x", "cut_2_y"]
    plate = Plate(specimen)
    shapes = real_modes(plate, G, 3).shapes
    counts = names_of(specimen).counts
    parts = np.einsum("pmm->pm", projected_parts(plate, shapes))
    K_0, K_1, M = parts[counts.K_0], parts[counts.K_1], parts[counts.M]
    for name in ("substrate_angle", "constraining_shear", "glue_shear", "patch_1_x", "cut_1_y", "cut_2_x"):
        k = names.index(name)
        logs = []
        for z in (1.0, -1.0):
            at = z * np.eye(len(names))[k]
            c = coefficients(numbers.moved_specimen(at), specimen)
            by_parts = (c.K_0.real @ K_0 + G * c.K_1 @ K_1) / (c.M @ M)
            other = Plate(replace(numbers.moved_specimen(at), elements=specimen.mesh))
            K = other.K_0.real + G * other.K_1
            of_other = [x @ (K @ x) / (x @ (other.M @ x)) for x in shapes.T]
            logs.append((np.log(by_parts), np.log(of_other)))
        parts_by, other_by = (a[0] - a[1] for a in zip(*logs, strict=True))
        scale = np.abs(other_by).max()
        assert parts_by == pytest.approx(other_by, rel=0.05, abs=0.05 * scale + 1e-6), name


def test_a_patch_from_edge_to_edge_cannot_be_laid_elsewhere():
    across = replace(PLATE, patches=(Patch(0.0, 0.1, 0.0, 0.2),))
    (shift,) = shifts_of(across)
    assert shift.name == "patch_1_x"
    assert shift.of(across, SHIFT_M)[0] == Patch(0.0, 0.1 + SHIFT_M, 0.0, 0.2)


def test_a_patch_cut_longer_ends_further_out_on_both_sides_and_lies_where_it_did():
    inside = replace(PLATE, patches=(Patch(0.05, 0.15, 0.0, 0.2),))
    laid, cut = shifts_of(inside)
    assert (cut.name, cut.stated_m(inside)) == ("cut_1_x", pytest.approx(0.1))
    moved = replace(inside, patches=laid.of(inside, 1e-3, cut.of(inside, 4e-3)))
    assert moved.patches[0] == Patch(pytest.approx(0.049), pytest.approx(0.153), 0.0, 0.2)
    assert [s.by_m(moved, inside) for s in (laid, cut)] == pytest.approx([1e-3, 4e-3])


def test_an_ordinary_plate_has_no_more_numbers_than_it_had():
    assert len(plate_numbers(PLATE)) == 13
    assert names_of(PLATE).counts.each == (16, 7, 8)


def test_the_model_s_error_counts_the_layers_that_are_there():
    f, modulus = [30.0, 300.0], np.array([G * (1 + 0.8j)] * 2)
    thick = replace(PLATE, core=replace(CORE, glue=(Glue(0.2e-3, 1e5, 1000.0),)), both_sides=True)
    plain, more = (theory_error(s, f, modulus) for s in (PLATE, thick))
    assert np.all(np.abs(more.delta) > 0)
    assert not np.allclose(more.delta, plain.delta, rtol=0.05)
    assert check_theory(EVERYTHING, CORE.law, f).acceptable


def test_effects_that_ask_for_the_whole_treatment_stand_on_no_patch():
    patched = replace(PLATE, patches=(Patch(0.0, 0.1, 0.0, 0.2),))
    for name in ("graded_core", "treatment_not_gripped"):
        assert CATALOGUE[name].standing_on(PLATE) is not None
        assert CATALOGUE[name].standing_on(patched) is None
    assert CATALOGUE["orthotropic_substrate"].standing_on(TURNED) is None
    for name in ("clamp_line", "uneven_clamp"):
        assert CATALOGUE[name].standing_on(EVERYTHING) is None
    assert CATALOGUE["clamp_compliance"].standing_on(EVERYTHING) is not None
    assert CATALOGUE["added_mass"].standing_on(EVERYTHING) is not None


@pytest.mark.parametrize("reach", [0.15, 1e-10])
def test_a_patch_about_the_axis_is_even_and_its_shift_across_is_not(reach):
    """To first order what one edge gives up the other one gains: even motions do not feel it."""
    L, B = PLATE.length_m, PLATE.width_m
    patch = Patch(0.2 * L, 0.7 * L, reach * B if reach > 1e-3 else 0.0, (1 - reach) * B)
    specimen = replace(PLATE, patches=(patch,))
    laid = ["patch_1_x", "patch_1_y"][: 1 + (reach > 1e-3)]
    assert [s.name for s in shifts_of(specimen)] == laid + [n.replace("patch", "cut") for n in laid]
    plate = Plate(specimen)
    assert specimen.only_even
    X = plate.even @ np.random.default_rng(0).normal(size=(plate.even.shape[1], 2))
    found, whole = (projected_parts(plate, X, one_parity=one) for one in (True, False))
    np.testing.assert_array_equal(found, whole)
    K_1 = found[names_of(specimen).counts.K_1]
    across = shifts_of(specimen)[len(laid) - 1]
    moved = replace(specimen, patches=across.of(specimen, SHIFT_M))
    c = coefficients(moved, specimen)
    K = X.T @ (Plate(moved).K_1 @ X) - X.T @ (plate.K_1 @ X)
    by = np.tensordot(c.K_1 - coefficients(specimen, specimen).K_1, K_1, 1)
    assert np.abs(by - K).max() < 1e-3 * np.abs(X.T @ (plate.K_1 @ X)).max()
