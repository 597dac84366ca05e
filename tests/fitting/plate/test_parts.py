"""Parts times coefficients beside the element's own matrices."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.laws.constant import ConstantModulus
from fitting.plate.element import DOFS, core_shear_stiffness
from fitting.plate.element import Shape as ElementShape
from fitting.plate.element_matrices import element_matrices
from fitting.plate.mesh import Mesh
from fitting.plate.part_matrices import element_parts, load_part, projected_parts
from fitting.plate.part_names import CORE, MASS, STIFFNESS
from fitting.plate.parts import coefficients, stretched
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face

LAW = ConstantModulus(1e6, 0.0)
REFERENCE = PlateSpecimen(
    0.12,
    0.09,
    "cantilever",
    Face(1.9e-3, 68.9e9, 0.3, 2700.0),
    Face(0.3e-3, 209e9, 0.3, 7890.0),
    Core(0.5e-3, 0.49, 789.5, LAW),
    elements=(4, 3),
)
FACES = st.builds(
    Face,
    thickness_m=st.floats(0.2e-3, 3e-3),
    young_pa=st.floats(1e9, 210e9),
    poisson=st.floats(0.2, 0.4),
    density_kg_m3=st.floats(1000, 8000),
    loss_factor=st.floats(0, 0.05),
)
CORES = st.builds(
    Core,
    thickness_m=st.floats(0.05e-3, 2e-3),
    poisson=st.floats(0.45, 0.499),
    density_kg_m3=st.floats(500, 2000),
    law=st.just(LAW),
)
SPECIMENS = st.builds(
    replace,
    st.just(REFERENCE),
    length_m=st.floats(0.08, 0.2),
    width_m=st.floats(0.06, 0.12),
    substrate=FACES,
    constraining=FACES,
    core=CORES,
)


def on_reference(A, specimen):
    """An element's matrix over the reference's degrees of freedom, whose rotations are another side's."""
    scale = np.tile(stretched(specimen, REFERENCE), 4)
    return scale[:, None] * A * scale


def sum_of(c, parts):
    return np.tensordot(c, parts, axes=1)


def assert_same(found, expected, tolerance=1e-12):
    # Entry by entry over the energies of the two degrees of freedom: their units differ.
    size = np.sqrt(np.abs(np.diag(expected)))
    scale = np.outer(size, size) + 1e-300
    assert np.abs((found - expected) / scale).max() < tolerance


@given(SPECIMENS)
def test_of_any_specimen_they_are_the_elements_matrices(specimen):
    e = element_matrices(specimen, Mesh(specimen.length_m, specimen.width_m, *REFERENCE.mesh))
    K_0, K_1, M = element_parts(REFERENCE)
    c = coefficients(specimen, REFERENCE)
    b, g = specimen.substrate.loss_factor, specimen.constraining.loss_factor
    faces = (1 + 1j * b) * e.K_substrate + (1 + 1j * g) * e.K_constraining
    assert_same(sum_of(c.K_0, K_0), on_reference(faces, specimen))
    assert_same(sum_of(c.M, M), on_reference(e.M, specimen))
    shape = ElementShape(specimen.length_m / 4, specimen.width_m / 3)
    shear = core_shear_stiffness(shape, specimen.core, specimen.substrate, specimen.constraining)
    assert_same(sum_of(c.K_1[:6], K_1[:6]), on_reference(shear, specimen))


@given(SPECIMENS)
def test_without_treatment_they_are_the_bare_elements_matrices(specimen):
    bare = specimen.bare
    e = element_matrices(bare, Mesh(bare.length_m, bare.width_m, *REFERENCE.mesh))
    K_0, _, M = element_parts(REFERENCE.bare)
    c = coefficients(bare, REFERENCE.bare)
    assert not c.K_1.any()
    assert_same(
        sum_of(c.K_0, K_0), on_reference((1 + 1j * bare.substrate.loss_factor) * e.K_substrate, specimen)
    )
    assert_same(sum_of(c.M, M), on_reference(e.M, specimen))


def test_of_the_reference_itself_the_core_is_whole():
    e = element_matrices(REFERENCE, Mesh(REFERENCE.length_m, REFERENCE.width_m, *REFERENCE.mesh))
    assert_same(sum_of(coefficients(REFERENCE, REFERENCE).K_1, element_parts(REFERENCE)[1]), e.K_1)


@pytest.mark.parametrize("step_m", [-0.6e-3, 0.0, 0.6e-3])
def test_what_the_core_carries_by_stretching_is_followed_nearly(step_m):
    """Two tolerances off: a part of a hundred thousandth, to a few percent of itself."""
    core = replace(REFERENCE.core, thickness_m=1.06 * REFERENCE.core.thickness_m, poisson=0.98 * 0.49)
    moved = replace(REFERENCE, length_m=REFERENCE.length_m + step_m, core=core)
    e = element_matrices(moved, Mesh(moved.length_m, moved.width_m, *REFERENCE.mesh))
    c, parts = coefficients(moved, REFERENCE).K_1, element_parts(REFERENCE)[1]
    expected = on_reference(e.K_1, moved)
    assert_same(sum_of(c, parts), expected, 1e-4)
    stretching = expected - sum_of(c[:6], parts[:6])
    assert np.linalg.norm(sum_of(c, parts) - expected) < 0.05 * np.linalg.norm(stretching)


@given(SPECIMENS)
def test_the_load_of_a_heave_is_the_plates(specimen):
    plate = Plate(specimen)
    found = -coefficients(specimen, REFERENCE).load * load_part(REFERENCE)[plate.free]
    scale = np.tile(stretched(specimen, REFERENCE), plate.mesh.nodes)[plate.free]
    np.testing.assert_allclose(found, scale * plate.base_load, atol=1e-12 * np.abs(found).max())


def test_on_a_basis_they_are_the_assembled_plates():
    plate = Plate(replace(REFERENCE, substrate=replace(REFERENCE.substrate, loss_factor=0.02)))
    V = np.random.default_rng(1).normal(size=(plate.size, 3))
    parts = projected_parts(plate, V)
    assert len(parts) == len(STIFFNESS) + len(CORE) + len(MASS)
    c = coefficients(plate.specimen, plate.specimen)
    K_0, K_1, M = np.split(parts, np.cumsum([len(STIFFNESS), len(CORE)]))
    for found, expected in (
        (sum_of(c.K_0, K_0), V.T @ (plate.K_0 @ V)),
        (sum_of(c.K_1, K_1), V.T @ (plate.K_1 @ V)),
        (sum_of(c.M, M), V.T @ (plate.M @ V)),
    ):
        np.testing.assert_allclose(found, expected, atol=1e-11 * np.abs(expected).max())


def test_a_plate_of_its_own_size_is_not_stretched():
    assert np.array_equal(stretched(REFERENCE, REFERENCE), np.ones(DOFS))
