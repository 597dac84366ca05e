import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from fitting.diagnosis.problem.pole_following import KnownPoles, ModulusNear
from fitting.dynamics.dynamic_stiffness import stacked


def matrices(detuning, coupling, loss):
    """Two oscillators near 1 rad/s, one of them lossy, and a third far above."""
    K_0 = np.diag([1.0, 1 + detuning, 9.0]).astype(complex)
    K_0[1, 1] += 1j * loss
    K_0[0, 1] = K_0[1, 0] = coupling
    K_0[0, 2] = K_0[2, 0] = K_0[1, 2] = K_0[2, 1] = 0.05
    return stacked(K_0, np.diag([0.1, 0.2, 0.0]), np.eye(3), np.zeros((3, 3)))


def exactly(moved, G):
    """All poles by the eigenvalues, and the modes as rows."""
    values, vectors = np.linalg.eig(moved[0] + G * moved[1])
    order = np.argsort(values.real)
    return np.sqrt(values[order]), vectors.T[order]


def known(at, modes, G, slope=0.0):
    count = len(at)
    near = ModulusNear(at.real, np.full(count, G, complex), np.full(count, slope, complex))
    return KnownPoles(at, modes, np.zeros(count, int), near)


@example(0.0117, 0.462, -0.0271, 0.0079)
@given(
    st.floats(0.0, 0.02),
    st.floats(0.4, 0.6),
    st.floats(-0.03, 0.03),
    st.floats(-0.01, 0.01),
)
def test_two_that_are_nearly_one_stay_two(detuning, of_loss, moved_by, coupled_by):
    # As stiff as one another and coupled by half of the loss they are one, modes and all. In the example
    # Rayleigh's quotient by itself, from the modes as they were, ends 0.6 % off.
    loss, G = 0.02, 0.1 + 0.05j
    before = matrices(detuning, of_loss * loss, loss)
    after = matrices(detuning + moved_by, of_loss * loss + coupled_by, loss)
    at, modes = exactly(before, G)
    expected = exactly(after, G)[0][:2]
    found = known(at[:2], modes[:2], G).followed(after)[0]
    off = np.abs(expected[:, None] - found)
    # Where they meet a pole moves with the root of what changes: eight digits of sixteen are left.
    assert off.min(axis=0).max() < 1e-6
    assert off.min(axis=1).max() < 1e-6


def test_the_modulus_at_the_pole_counts_not_that_below_it():
    moved = matrices(0.3, 0.01, 0.02)
    G, slope = 0.1 + 0.05j, 0.04 + 0.02j
    at, modes = exactly(moved, G)
    poles = known(at[:2], modes[:2], G, slope)
    found, y = poles.followed(moved)
    K_0, K_1, M, _ = moved
    for p, shape, omega in zip(found, y, poles.modulus.omega, strict=True):
        A = K_0 + (G + slope * (p - omega)) * K_1 - p**2 * M
        assert np.linalg.norm(A @ shape) < 1e-6 * np.linalg.norm(shape)


def test_clusters_are_followed_each_by_itself():
    before, after, G = matrices(0.3, 0.01, 0.02), matrices(0.31, 0.01, 0.02), 0.1 + 0.05j
    at, modes = exactly(before, G)
    twice = np.array([0, 1, 0])
    near = ModulusNear(at[twice].real, np.full(3, G), np.zeros(3, complex))
    found = KnownPoles(at[twice], modes[twice], np.array([0, 0, 1]), near).followed(after)[0]
    assert found[2] == pytest.approx(found[0], rel=1e-8)


def test_on_more_columns_the_modes_are_zero_elsewhere():
    at, modes = exactly(matrices(0.3, 0.01, 0.02), 0.1)
    own = np.array([True, False, True, True])
    wider = known(at, modes, 0.1).on(own)
    np.testing.assert_array_equal(wider.modes[:, own], modes)
    assert not wider.modes[:, ~own].any()
