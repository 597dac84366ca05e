from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fitting.dynamics.complex_modes import complex_modes
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct, solve_direct
from fitting.dynamics.real_modes import real_modes
from fitting.errors import OutsideModel
from fitting.laws.constant import ConstantModulus
from fitting.laws.fractional_zener import FractionalZener
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face


def hertz(modes):
    return modes.omega / (2 * np.pi)


def modes_of(specimen, count):
    law = specimen.core.law if specimen.core is not None else None
    found = complex_modes(Plate(specimen), law, count)
    return np.array([m.frequency_hz for m in found]), np.array([m.loss_factor for m in found])


def test_simply_supported_plate_has_its_exact_modes(johnson_kienholz):
    f, eta = modes_of(replace(johnson_kienholz, elements=(24, 20)), 5)
    np.testing.assert_allclose(f, [60.237, 115.229, 130.433, 178.474, 195.437], rtol=4e-3)
    np.testing.assert_allclose(eta, [0.19013, 0.20344, 0.19920, 0.18062, 0.17369], rtol=1e-2)


def test_simply_supported_plate_with_a_fractional_core_has_its_exact_modes(johnson_kienholz):
    law = FractionalZener(0.5e6, 23.3165e6, 1.4052e-5, 0.7915)
    core = replace(johnson_kienholz.core, law=law, density_kg_m3=1600.0)
    f, eta = modes_of(replace(johnson_kienholz, core=core, elements=(24, 20)), 3)
    np.testing.assert_allclose(f, [54.499, 108.573, 124.113], rtol=4e-3)
    np.testing.assert_allclose(eta, [0.20805, 0.29141, 0.30302], rtol=1e-2)


def test_cantilever_plate_agrees_with_a_converged_solid_model(zn1_plate):
    f = hertz(real_modes(zn1_plate, 0.5e6, 6))
    np.testing.assert_allclose(f, [20.68, 56.58, 100.93, 176.05, 242.57, 269.45], rtol=3e-3)


def test_modes_with_table_4_agree_with_a_converged_solid_model(zn1_table4):
    f, eta = modes_of(zn1_table4, 6)
    np.testing.assert_allclose(f, [19.39, 55.53, 100.83, 179.02, 252.16, 276.25], rtol=3e-3)
    np.testing.assert_allclose(eta, [0.1003, 0.0975, 0.1381, 0.1398, 0.1847, 0.1351], rtol=5e-3)


def test_response_with_table_4_agrees_with_a_converged_solid_model(zn1_table4, zn1_plate, table5):
    w = table5.omega
    x = displacement_direct(zn1_plate, viscous_damping(zn1_plate), w, zn1_table4.core.law.modulus(w))
    solid = [0.0631, 0.0869, 0.0696, 0.0191, 0.0271, 0.0246, 0.0097, 0.0114, 0.0092]
    np.testing.assert_allclose(np.abs(w * x * 9.81), solid, rtol=2.5e-2)


def test_bare_cantilever_plate_agrees_with_a_converged_solid_model(zn1):
    f = hertz(real_modes(Plate(zn1.bare), 0.0, 6))
    np.testing.assert_allclose(f, [17.72, 59.8, 110.1, 201.6, 275.0, 316.0], rtol=3e-3)


def test_narrow_plate_agrees_with_the_sandwich_beam():
    # Soni; Bilasse and Daya. A plate is a little stiffer than a beam: the clamp holds its width.
    face = Face(1.524e-3, 69e9, 0.3, 2766.0)
    core = Core(0.127e-3, 0.3, 968.1, ConstantModulus(1.794e6 / (2 * 1.3), 0.1))
    narrow = PlateSpecimen(0.1778, 0.0127, "cantilever", face, face, core, elements=(60, 5))
    f, eta = modes_of(narrow, 4)
    flexural = [0, 1, 3]  # mode 3 of the plate is a twist
    np.testing.assert_allclose(f[flexural], [64.1, 296.4, 743.7], rtol=1e-2)
    np.testing.assert_allclose(eta[flexural] / 0.1, [0.281, 0.242, 0.154], rtol=1e-2)


# Leissa, J. Sound Vib. 31 (1973): square plates, nu 0.3, omega a^2 sqrt(rho h / D).
LEISSA = {
    "clamped-clamped-clamped-clamped": [35.992, 73.413, 73.413, 108.27, 131.64],
    "cantilever": [3.4917, 8.5246, 21.429, 27.331, 31.111],
    "simply-supported": [19.739, 49.348, 49.348, 78.957, 98.696],
    "free": [13.489, 19.789, 24.432, 35.024, 35.024],
    "clamped-free-clamped-free": [22.272, 26.529, 43.664, 61.466, 67.549],
    "simply-supported-free-simply-supported-free": [9.6314, 16.135, 36.726, 38.945, 46.738],
    "clamped-clamped-free-free": [6.9421, 24.034, 26.681, 47.785, 63.039],
    "simply-supported-clamped-simply-supported-clamped": [28.951, 54.743, 69.327, 94.585, 102.216],
}


@pytest.mark.parametrize("boundary", LEISSA)
def test_plates_on_any_edges_have_their_published_frequencies_and_no_rigid_modes(zn1, boundary):
    square = replace(zn1.bare, boundary=boundary, length_m=0.2, width_m=0.2, elements=(20, 20))
    face = square.substrate
    D = face.young_pa * face.thickness_m**3 / (12 * (1 - 0.3**2))
    scale = 0.2**2 * np.sqrt(face.density_kg_m3 * face.thickness_m / D)
    found = real_modes(Plate(square), 0.0, 5).omega * scale
    np.testing.assert_allclose(found, LEISSA[boundary], rtol=1e-2)


@pytest.mark.parametrize(
    ("boundary", "rigid"),
    [("free", 6), ("cantilever", 0), ("simply-supported", 0), ("simply-supported-free-free-free", 3)],
)
def test_rigid_motions_cost_no_energy(coarse, boundary, rigid):
    plate = Plate(replace(coarse, boundary=boundary))
    R = plate.rigid
    assert R.shape == (plate.size, rigid)
    strained = np.abs(R.T @ (plate.K_0.real + 1e6 * plate.K_1) @ R)
    assert np.all(strained < 1e-9 * (plate.K_0.real.diagonal() @ np.square(R)).max(initial=1e-9))


def test_edges_one_by_one_are_the_boundary_that_has_a_name(coarse):
    by_edges = replace(coarse, boundary="clamped-free-free-free")
    assert by_edges == coarse
    turned = replace(coarse, boundary="free-clamped-free-free", length_m=coarse.width_m)
    assert turned.edges == ("free", "clamped", "free", "free")
    for nonsense in ("clamped-free-free", "glued-free-free-free", "", "free-free"):
        with pytest.raises(OutsideModel, match="expected 'cantilever'"):
            replace(coarse, boundary=nonsense)


def test_default_mesh_is_within_a_thousandth_of_its_limit_and_errors_shrink_quadratically(zn1, monkeypatch):
    # Of the elements: what free edges lack in twist shrinks them from the other side.
    monkeypatch.setattr("fitting.plate.edge_twist.EDGE_WIDTH", 0.0)
    finer, meshes = 1.5, [(16, 12), (24, 18), (36, 27), zn1.mesh]
    *f, default = (hertz(real_modes(Plate(replace(zn1, elements=m)), 0.5e6, 8)) for m in meshes)
    # Richardson: the limit from the two finer meshes at the rate the three show.
    first, second = f[1] - f[0], f[2] - f[1]
    rate = np.log(np.abs(first / second)) / np.log(finer)
    limit = f[2] + second / (finer**rate - 1)
    assert zn1.mesh == (40, 26)
    assert np.all(np.abs(default / limit - 1) < 1e-3)
    assert np.all(rate > 1.2), rate
    assert np.median(rate) == pytest.approx(2, abs=0.5)


def test_vanishing_core_leaves_two_free_faces(coarse_plate, coarse):
    # Two faces bending together without coupling: D = sum of theirs over the sum of all masses.
    soft = hertz(real_modes(coarse_plate, 1e-3, 1))[0]
    faces = coarse.substrate, coarse.constraining
    rigidity = sum(f.young_pa * f.thickness_m**3 / (12 * (1 - 0.3**2)) for f in faces)
    areal = sum(f.density_kg_m3 * f.thickness_m for f in faces) + 789.5 * 0.5e-3
    one = coarse.substrate
    # Struck, that it lacks twist at its free edges as both faces do.
    bare = hertz(real_modes(Plate(replace(coarse.bare, force_m=(0.29, 0.02))), 0.0, 1))[0]
    D = one.young_pa * one.thickness_m**3 / (12 * (1 - 0.3**2))
    expected = bare * np.sqrt(rigidity / D * one.density_kg_m3 * one.thickness_m / areal)
    assert soft == pytest.approx(expected, rel=1e-4)


def test_rigid_core_makes_the_composite_section(zn1):
    # A core as stiff in shear as its faces, but light: bending about the common neutral plane.
    plate = Plate(replace(zn1, elements=(40, 26)))
    stiff = hertz(real_modes(plate, 1e9, 1))[0]
    b, c = zn1.substrate, zn1.constraining
    E = [b.young_pa / (1 - 0.3**2), 2e9 / (1 - 0.49), c.young_pa / (1 - 0.3**2)]
    h = [b.thickness_m, zn1.core.thickness_m, c.thickness_m]
    z = [h[0] / 2, h[0] + h[1] / 2, h[0] + h[1] + h[2] / 2]
    neutral = sum(e * t * y for e, t, y in zip(E, h, z, strict=True)) / sum(np.multiply(E, h))
    rigidity = sum(e * (t**3 / 12 + t * (y - neutral) ** 2) for e, t, y in zip(E, h, z, strict=True))
    areal = 2700 * 1.9e-3 + 789.5 * 0.5e-3 + 7890 * 0.3e-3
    bare = hertz(real_modes(Plate(zn1.bare), 0.0, 1))[0]
    expected = bare * np.sqrt(rigidity / (E[0] * h[0] ** 3 / 12) * 2700 * 1.9e-3 / areal)
    # The layers' Poisson ratios differ a little, and the core still shears a little.
    assert stiff == pytest.approx(expected, rel=1e-2)


@settings(max_examples=15)
@given(st.floats(4, 7), st.floats(0.01, 0.5))
def test_frequencies_rise_with_the_core_modulus(coarse_plate, log_G, step):
    low, high = (real_modes(coarse_plate, 10**g, 6).omega for g in (log_G, log_G + step))
    assert np.all(high > low)


inside = st.tuples(st.floats(0.02, 0.3002), st.floats(0, 0.1999))


@settings(max_examples=15)
@given(inside, inside, st.floats(10, 400))
def test_response_is_reciprocal(coarse_plate, here, there, f):
    omega, G = 2 * np.pi * f, 0.5e6 * (1 + 0.5j)
    rows = np.column_stack([coarse_plate.observe(*here), coarse_plate.observe(*there)])
    A = coarse_plate.dynamic_stiffness(omega, G)
    X = rows.T @ solve_direct(A, omega, viscous_damping(coarse_plate), rows)
    assert X[0, 1] == pytest.approx(X[1, 0], rel=1e-7, abs=1e-9 * np.abs(X).max())


def test_motions_even_and_odd_in_y_complete_each_other(coarse_plate):
    even, odd = coarse_plate.even, coarse_plate.odd
    assert even.shape[1] + odd.shape[1] == coarse_plate.size
    assert abs(even.T @ odd).max() < 1e-12
    load = coarse_plate.base_load
    np.testing.assert_allclose(even @ (even.T @ load), load, atol=1e-12 * np.abs(load).max())


@pytest.mark.parametrize("elements", [(9, 7), (8, 8)])
def test_base_response_lies_in_the_even_motions(coarse, elements):
    plate = Plate(replace(coarse, elements=elements))
    A, P = plate.dynamic_stiffness(600.0, 0.5e6 * (1 + 0.5j)), plate.even
    none = viscous_damping(Plate(replace(coarse, elements=elements, modal_ratios=())))
    whole = solve_direct(A, 600.0, none, plate.base_load[:, None])
    half = P @ solve_direct(P.T @ A @ P, 600.0, none.projected(P), (P.T @ plate.base_load)[:, None])
    np.testing.assert_allclose(half, whole, atol=1e-9 * np.abs(whole).max())


def test_viscous_damping_gives_each_mode_its_ratio(coarse, coarse_plate):
    C = viscous_damping(coarse_plate)
    modes = real_modes(coarse_plate, 0.5e6, 8)
    damping = modes.shapes.T @ C.U @ np.diag(C.d) @ C.U.T @ modes.shapes
    np.testing.assert_allclose(np.diag(damping) / (2 * modes.omega), coarse.modal_ratios, rtol=1e-6)


def test_clamped_pickup_does_not_move(coarse_plate):
    assert np.abs(coarse_plate.observe(0.0, 0.1)).max() < 1e-12


def test_pickup_on_a_held_edge_is_refused(coarse):
    with pytest.raises(OutsideModel, match="held edge"):
        _ = Plate(replace(coarse, pickup_m=(0.0, 0.1))).pickup


def test_more_modes_than_the_mesh_has_are_refused(coarse):
    with pytest.raises(OutsideModel, match="refine"):
        viscous_damping(Plate(replace(coarse, elements=(2, 2), modal_ratios=(0.001,) * 50)))


@pytest.mark.parametrize("point", [(-0.001, 0.1), (0.31, 0.1), (0.1, -1e-9), (0.1, 0.2)])
def test_point_off_the_plate_is_refused(coarse_plate, point):
    with pytest.raises(OutsideModel, match="off the plate"):
        coarse_plate.observe(*point)


def test_free_plate_has_no_base(coarse):
    with pytest.raises(OutsideModel, match="no base"):
        _ = Plate(replace(coarse, boundary="free")).base_load


def test_progress_of_modes_is_told_from_the_first_factorisation_on(coarse):
    told = []
    complex_modes(Plate(coarse), coarse.core.law, 2, told.append)
    assert told == [0.2, 0.4, 0.6, 0.8, 1.0]
