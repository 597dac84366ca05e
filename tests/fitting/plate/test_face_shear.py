"""Faces sheared by their core: against exact elasticity, and as the sum of a plate's parts."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.discrepancy.exact_layers import exact_lambda
from fitting.discrepancy.layer_theory import layerwise_lambda
from fitting.discrepancy.mesh_error import mesh_error
from fitting.discrepancy.model_error import model_error_at
from fitting.discrepancy.theory_error import stack
from fitting.dynamics.complex_modes import complex_modes
from fitting.laws.constant import ConstantModulus
from fitting.plate.element_matrices import element_matrices
from fitting.plate.face_shear import edge_twist_left, share_of_faces, with_face_shear
from fitting.plate.layers_array import layers_of, specimen_of
from fitting.plate.mesh import mesh_of
from fitting.plate.part_matrices import element_parts
from fitting.plate.parts import coefficients, stretched
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face, Glue
from fitting.stated.patches import Patch

GLASS = Face(4e-3, 70e9, 0.22, 2500.0)
ALUMINIUM = Face(2e-3, 70e9, 0.33, 2700.0)
STEEL = Face(1e-3, 200e9, 0.3, 7800.0)
STACKS = {
    "laminated glass": (GLASS, 0.38e-3, GLASS),
    "aluminium": (ALUMINIUM, 0.1e-3, ALUMINIUM),
    "laminated steel": (STEEL, 0.05e-3, STEEL),
    "unlike faces": (replace(ALUMINIUM, thickness_m=3e-3), 0.1e-3, replace(ALUMINIUM, thickness_m=1e-3)),
}


def plate(name, **stated):
    b, h_v, c = STACKS[name]
    core = Core(h_v, 0.45, 1000.0, ConstantModulus(1e8, 0.5))
    made = PlateSpecimen(0.3, 0.2, "simply-supported", b, constraining=c, core=core, elements=(12, 8))
    return replace(made, **{"faces_shear": True, **stated})


def off(value, exact):
    """Of frequency and loss factor, in %."""
    eta, its = value.imag / value.real, exact.imag / exact.real
    return 100 * (np.sqrt(value.real / exact.real) - 1), 100 * (eta / its - 1)


@pytest.mark.parametrize("modulus_pa", [1e7, 1e8])
@pytest.mark.parametrize("name", STACKS)
def test_waves_are_those_of_exact_elasticity(name, modulus_pa):
    sheared, k = plate(name), 2 * np.pi / np.array([1.0, 0.3, 0.15])
    G = np.full(3, modulus_pa * (1 + 0.5j))
    exact = exact_lambda(stack(sheared, G), k)
    f, eta = off(layerwise_lambda(sheared, k, G), exact)
    stiff_f, stiff_eta = off(layerwise_lambda(replace(sheared, faces_shear=False), k, G), exact)
    # Rotary inertia is what is left: thicker faces have more of it.
    assert np.abs(f).max() < 0.2 * np.abs(stiff_f).max() < 0.2
    assert np.abs(eta).max() < max(0.3 * np.abs(stiff_eta).max(), 0.03)
    assert np.all(stiff_f > 0)


def moved(specimen):
    """Larger, of another face and core, on the same number of elements."""
    substrate = replace(specimen.substrate, thickness_m=1.2 * specimen.substrate.thickness_m, young_pa=6e10)
    core = replace(specimen.core, thickness_m=1.3e-4)
    return replace(specimen, length_m=0.33, width_m=0.19, substrate=substrate, core=core)


@pytest.mark.parametrize("both_sides", [False, True])
@pytest.mark.parametrize("glue", [(), (Glue(1e-4, 1e9, 1200.0, 0.02),)])
def test_the_element_is_the_sum_of_its_parts_for_any_stated_numbers(glue, both_sides):
    lossy = replace(plate("unlike faces"), both_sides=both_sides)
    lossy = replace(lossy, substrate=replace(lossy.substrate, loss_factor=3e-3))
    reference = replace(lossy, core=replace(lossy.core, glue=glue))
    parts = element_parts(reference)
    for one in (reference, moved(reference)):
        e, c = element_matrices(one, mesh_of(one)), coefficients(one, reference)
        factors = np.ones((4, mesh_of(one).dofs))
        factors[:, :7] = stretched(one, reference)
        scale = np.outer(factors, factors)
        faces = (1 + 1j * one.substrate.loss_factor) * e.K_substrate + e.K_constraining + e.K_slip
        for whole, of, its in ((faces, c.K_0, parts[0]), (e.M, c.M, parts[2])):
            np.testing.assert_allclose(
                np.tensordot(of, its, axes=1), whole * scale, atol=1e-12 * np.abs(whole * scale).max()
            )
    # What is counted is the reference's, whatever plate stands on its parts.
    plain = coefficients(replace(reference, faces_shear=False), reference)
    np.testing.assert_array_equal(plain.K_0, coefficients(reference, reference).K_0)
    size = np.array([reference.length_m, reference.width_m, *reference.mesh])
    again = specimen_of(size, layers_of(reference))
    np.testing.assert_allclose(coefficients(again, reference).K_0, coefficients(reference, reference).K_0)


def test_modes_of_a_simply_supported_plate_are_exact_but_for_its_mesh():
    made, law = plate("aluminium"), ConstantModulus(1e8, 0.5)
    k = np.array([np.pi * np.hypot(1 / 0.3, 1 / 0.2)])
    exact = exact_lambda(stack(made, np.array([1e8 * (1 + 0.5j)])), k)[0]

    def its(faces_shear):
        """Taken to ever smaller elements."""
        f, eta = [], []
        for n in (1, 2):
            (mode,) = complex_modes(
                Plate(replace(made, elements=(12 * n, 8 * n), faces_shear=faces_shear)), law, 1
            )
            f.append(mode.frequency_hz)
            eta.append(mode.loss_factor)
        return np.array([one[1] + (one[1] - one[0]) / 3 for one in (f, eta)])

    right = np.array([np.sqrt(exact.real) / (2 * np.pi), exact.imag / exact.real])
    assert np.all(np.abs(its(faces_shear=True) / right - 1) < (2e-4, 1.5e-2))
    assert its(faces_shear=False)[0] / right[0] - 1 > 5e-4


def test_it_is_counted_where_the_core_is_stiff():
    made = plate("laminated steel", faces_shear=False)
    assert not with_face_shear(made, 1e6).faces_shear
    assert with_face_shear(made, 5e7).faces_shear
    assert share_of_faces(made.bare, 5e7) == 0.0
    assert not made.bare.faces_shear
    # h/(2 kappa G_f) of two faces, beside H/G of the core.
    faces, core = 2 * 1e-3 / (4 * 5 / 6 * 200e9 / 2.6), 0.05e-3 / 5e7
    assert share_of_faces(made, 5e7) == pytest.approx(faces / (faces + core))


def test_a_free_edge_does_not_lose_its_twist_twice():
    """Elements hardly wider than a face is thick let its sections turn there themselves."""
    assert edge_twist_left(GLASS, 1e-3) == edge_twist_left(GLASS, 2e-3) < 0.15
    assert edge_twist_left(GLASS, 7e-3) == pytest.approx(0.5, abs=0.1)
    assert edge_twist_left(STEEL, 7e-3) > 0.85
    made = plate("laminated glass", boundary="free").with_law(ConstantModulus(1e6, 0.3))
    coarse, fine = (
        complex_modes(Plate(replace(made, elements=n)), made.core.law, 1)[0].frequency_hz
        for n in ((14, 9), (28, 18))
    )
    assert fine == pytest.approx(coarse, rel=1e-3)


def test_beside_patches_it_is_not_counted():
    """A slip that ends with its patch would leave a hinge there."""
    made = replace(plate("laminated steel", faces_shear=False), patches=(Patch(0.0, 0.15, 0.0, 0.2),))
    assert not with_face_shear(made, 5e7).faces_shear


def test_no_slip_moves_without_mass():
    """What is factorised of a plate with its mass alone, and its waves on the mesh."""
    made = plate("aluminium", force_m=(0.1, 0.05), pickup_m=(0.2, 0.1))
    M = Plate(made).M.toarray()
    np.linalg.cholesky(M)
    assert np.sort(np.diag(M))[0] > 1e-9 * M.max()
    G = np.array([1e8 * (1 + 0.5j)])
    found = mesh_error(made, np.array([20.0]), G)
    assert 0 < found.frequency[0] < 0.05
    assert model_error_at(made, np.array([300.0]), G).frequency[0] < 0.05
