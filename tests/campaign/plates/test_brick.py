"""A brick of the solid plate beside what any solid body does."""

import numpy as np
import pytest

from campaign.plates.brick import isotropic, mass, metal, stiffness, unit_core
from campaign.plates.hammer import FREQUENCY_SCATTER, MODES, hammer_test

X, Y, T = np.array([0.0, 0.03]), np.array([0.0, 0.02]), 0.001
E, NU, RHO = 7e10, 0.33, 2700.0


def nodes():
    """Shape (27, 3), in the brick's order."""
    axes = (np.array([a, (a + b) / 2, b]) for a, b in ((*X,), (*Y,), (0.0, T)))
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(27, 3)


def test_a_brick_resists_no_rigid_motion():
    K = stiffness(X, Y, T, metal(E, NU))[0, 0]
    turns = [np.cross(axis, nodes()).ravel() for axis in np.eye(3)]
    moves = [np.tile(axis, 27) for axis in np.eye(3)]
    for motion in [*moves, *turns]:
        assert np.abs(K @ motion).max() < 1e-9 * np.abs(K).max() * np.abs(motion).max()
    assert np.linalg.matrix_rank(K, tol=1e-9 * np.abs(K).max()) == 81 - 6


@pytest.mark.parametrize("rolled", [0.0, 0.1])
def test_a_pulled_metal_holds_youngs_modulus_times_the_square_of_strain_along_each_axis(rolled):
    C = metal(E, NU, rolled)
    K = stiffness(X, Y, T, C)[0, 0]
    volume = np.ptp(X) * np.ptp(Y) * T
    young = E * np.array([1 + rolled / 2, 1 - rolled / 2, 1.0])
    for axis in range(2):
        # Free across: the strain that leaves stress along the axis alone.
        strain = np.linalg.solve(np.einsum("iijj->ij", C), np.eye(3)[axis])
        u = (nodes() * strain / strain[axis]).ravel()
        assert u @ K @ u == pytest.approx(young[axis] * volume, rel=1e-9)


def test_a_metal_that_is_not_rolled_is_isotropic():
    shear = E / (2 * (1 + NU))
    assert metal(E, NU, 1e-12) == pytest.approx(isotropic(2 * shear * NU / (1 - 2 * NU), shear), rel=1e-9)


def test_a_core_of_unit_shear_modulus_is_sheared_by_its_volume():
    K = stiffness(X, Y, T, unit_core(0.49))[0, 0]
    u = np.zeros((27, 3))
    u[:, 0] = nodes()[:, 2]
    assert u.ravel() @ K @ u.ravel() == pytest.approx(np.ptp(X) * np.ptp(Y) * T, rel=1e-9)


def test_a_brick_weighs_its_volume_times_its_density():
    M = mass(X, Y, T, RHO)[0, 0]
    for axis in np.eye(3):
        along = np.tile(axis, 27)
        assert along @ M @ along == pytest.approx(RHO * np.ptp(X) * np.ptp(Y) * T, rel=1e-12)


class Modes:
    """Of a plate that needs nothing else."""

    def __init__(self, frequency_hz):
        self.eigenvalues = (2 * np.pi * np.asarray(frequency_hz)) ** 2

    def modes(self, _, count):
        return self.eigenvalues[:count], None


def test_a_clamp_that_does_not_yield_leaves_the_rigid_plates_frequencies():
    f = 20.0 * np.arange(1, MODES + 1) ** 2
    rigid, sprung = Modes(f), Modes(0.9 * f)
    ratios = np.full(MODES, 0.002)
    rng = np.random.default_rng(3)
    made = [hammer_test(rng, rigid, sprung, ratios, 0.05, yields=False) for _ in range(50)]
    off = np.array([one.frequency_hz / f - 1 for one in made])
    assert abs(off.mean()) < 5 * FREQUENCY_SCATTER / np.sqrt(off.size)
    assert off.std() == pytest.approx(FREQUENCY_SCATTER, rel=0.2)
    assert np.std([one.ratios / 0.002 for one in made]) == pytest.approx(0.05, rel=0.2)


def test_a_clamp_that_yields_lowers_mode_1_by_less_than_half_a_percent_and_the_others_alike():
    f = 20.0 * np.arange(1, MODES + 1) ** 2
    rng = np.random.default_rng(4)
    made = [hammer_test(rng, Modes(f), Modes(0.9 * f), np.ones(MODES), 0.0) for _ in range(50)]
    fall = np.array([1 - np.mean(one.frequency_hz / f) for one in made])
    rigid = np.abs(fall) < 5 * FREQUENCY_SCATTER / np.sqrt(MODES)
    assert 10 < rigid.sum() < 40
    assert 0.001 < fall.max() < 0.005
