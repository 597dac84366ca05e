import numpy as np
import pytest

from fitting.laws.constant import ConstantModulus
from fitting.plate import element
from fitting.plate.element import DOFS, THETA_X, THETA_Y, U_B, U_C, V_B, V_C, Shape, W
from fitting.stated.layers import Core, Face

A, B = 0.02, 0.03
SHAPE = Shape(A, B)
SUBSTRATE = Face(1.9e-3, 68.9e9, 0.3, 2700.0)
CONSTRAINING = Face(0.3e-3, 209e9, 0.3, 7890.0)
CORE = Core(0.5e-3, 0.49, 789.5, ConstantModulus(1e6, 0.0))
# Between the faces' neutral planes.
D = 0.5e-3 + (0.3e-3 + 1.9e-3) / 2


def nodal(field):
    """Degrees of freedom of a motion given as functions of (x, y)."""
    return np.concatenate([[field(cx * A, cy * B)[k] for k in range(DOFS)] for cx, cy in element.CORNERS])


def stiffnesses():
    return (
        element.face_stiffness(SHAPE, SUBSTRATE, U_B, V_B),
        element.face_stiffness(SHAPE, CONSTRAINING, U_C, V_C),
        element.core_stiffness(SHAPE, CORE, SUBSTRATE, CONSTRAINING),
    )


RIGID = {
    "heave": lambda x, y: (0, 0, 0, 0, 1, 0, 0),
    # A tilt takes the constraining layer's neutral plane along: u_c - u_b = -d w_x.
    "pitch": lambda x, y: (-D, 0, 0, 0, x, 0, -1),
    "roll": lambda x, y: (0, -D, 0, 0, y, 1, 0),
    "surge": lambda x, y: (1, 0, 1, 0, 0, 0, 0),
    "yaw": lambda x, y: (-y, x, -y, x, 0, 0, 0),
}


@pytest.mark.parametrize("motion", RIGID)
def test_rigid_motion_stores_no_energy(motion):
    q = nodal(RIGID[motion])
    for K in stiffnesses():
        assert q @ K @ q == pytest.approx(0, abs=1e-9 * np.abs(K).max() * (q @ q))


def test_matrices_are_symmetric():
    M = element.core_mass(SHAPE, CORE, SUBSTRATE, CONSTRAINING)
    for matrix in (*stiffnesses(), M):
        np.testing.assert_allclose(matrix, matrix.T, atol=1e-12 * np.abs(matrix).max())


def test_constant_curvature_has_its_exact_bending_energy():
    q = nodal(lambda x, y: (0, 0, 0, 0, x * x, 0, -2 * x))
    K = element.face_stiffness(SHAPE, SUBSTRATE, U_B, V_B)
    rigidity = SUBSTRATE.young_pa * SUBSTRATE.thickness_m**3 / (12 * (1 - 0.3**2))
    assert q @ K @ q == pytest.approx(rigidity * 2**2 * A * B, rel=1e-10)


def test_uniform_slip_of_the_faces_shears_the_core():
    q = nodal(lambda x, y: (1, 0, 0, 0, 0, 0, 0))
    K = element.core_stiffness(SHAPE, CORE, SUBSTRATE, CONSTRAINING)
    assert q @ K @ q == pytest.approx(A * B / CORE.thickness_m, rel=1e-10)


def test_uniform_stretch_has_its_exact_membrane_energy():
    q = nodal(lambda x, y: (0, 0, x, 0, 0, 0, 0))
    K = element.face_stiffness(SHAPE, SUBSTRATE, U_B, V_B)
    stiffness = SUBSTRATE.young_pa * SUBSTRATE.thickness_m / (1 - 0.3**2)
    assert q @ K @ q == pytest.approx(stiffness * A * B, rel=1e-10)


@pytest.mark.parametrize("motion", ["heave", "surge"])
def test_mass_of_a_rigid_motion_is_that_of_the_layers(motion):
    q = nodal(RIGID[motion])
    M = (
        element.face_mass(SHAPE, SUBSTRATE, U_B, V_B)
        + element.face_mass(SHAPE, CONSTRAINING, U_C, V_C)
        + element.core_mass(SHAPE, CORE, SUBSTRATE, CONSTRAINING)
    )
    areal = 2700 * 1.9e-3 + 7890 * 0.3e-3 + 789.5 * 0.5e-3
    assert q @ M @ q == pytest.approx(areal * A * B, rel=1e-10)


def test_deflection_reads_its_own_degrees_of_freedom_at_a_corner():
    at_corner = SHAPE.deflection(A, B)
    slope_y, slope_x = SHAPE.deflection(A, B, dy=1), SHAPE.deflection(A, B, dx=1)
    expected = np.zeros((3, 28))
    expected[0, 2 * DOFS + W] = 1
    expected[1, 2 * DOFS + THETA_X] = 1
    expected[2, 2 * DOFS + THETA_Y] = -1
    np.testing.assert_allclose([at_corner, slope_y, slope_x], expected, atol=1e-9)
