"""Complex modes of small matrices beside numpy's, the whole of them and sought among real ones."""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from fitting.laws.constant import ConstantModulus
from fitting.laws.fractional_zener import FractionalZener
from fitting.mode_tables.modes import ModalMatrices, modes_of
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

CONSTANT = ConstantModulus(1e6, 0.4)
ZENER = FractionalZener(g0_pa=0.27e6, ginf_pa=4.1e6, tau_s=1.21e-3, alpha=0.83)


def matrices(size, rigid=False):
    """A row of masses on springs, elastic and viscoelastic ones; held at one end unless rigid."""
    chain = 2 * np.eye(size) - np.eye(size, k=1) - np.eye(size, k=-1)
    chain[-1, -1] = 1.0
    if rigid:
        chain[0, 0] = 1.0
    # Not in proportion, so that real modes are not the complex ones.
    grade = np.ones(size) if rigid else np.linspace(0.5, 1.5, size)
    other = chain * grade[:, None] * grade
    return ModalMatrices(3e6 * chain + 0j, 0.5 * other, np.eye(size), np.zeros((size, size)))


@pytest.mark.parametrize("size", [6, 60])
def test_modes_of_a_constant_law_are_numpy_s(size):
    A = matrices(size)
    expected = np.linalg.eigvals(A.K_0 + CONSTANT.modulus(np.ones(1))[0] * A.K_1)
    expected = expected[np.argsort(expected.real)][:3]
    found = modes_of(A, CONSTANT, 3, 5.0)
    assert [m.eigenvalue for m in found] == pytest.approx(expected.tolist(), rel=1e-6)
    assert all(m.shape @ (A.M @ m.shape) == pytest.approx(1.0) for m in found)


def test_a_law_is_taken_at_each_mode_s_own_frequency():
    A = matrices(6)
    for mode in modes_of(A, ZENER, 3, 5.0):
        K = A.stiffness(complex(ZENER.modulus(np.array([np.sqrt(mode.eigenvalue.real)]))[0]), 0.0)
        np.testing.assert_allclose(K @ mode.shape, mode.eigenvalue * mode.shape, atol=1e-6 * np.abs(K).max())


def test_a_rigid_mode_is_not_counted():
    A = matrices(6, rigid=True)
    (first, *_) = modes_of(A, CONSTANT, 2, 5.0)
    G = 3e6 + 0.5 * CONSTANT.modulus(np.ones(1))[0]
    assert first.eigenvalue == pytest.approx(4 * np.sin(np.pi / 12) ** 2 * G, rel=1e-9)


def test_what_has_no_stiffness_has_no_modes_and_says_so_without_a_warning(recwarn):
    A = matrices(6)
    nothing = ModalMatrices(-A.K_0, 0 * A.K_1, A.M, A.C_1)
    assert modes_of(nothing, CONSTANT, 3, 5.0) == []
    assert not recwarn.list


def test_modes_that_change_places_with_frequency_are_in_the_order_of_their_own():
    # One mass on the core alone, the other on a spring: the law's slope takes the first past the second.
    A = ModalMatrices(np.diag([0.0, 4e5]) + 0j, np.diag([1.0, 0.0]), np.eye(2), np.zeros((2, 2)))
    first, second = modes_of(A, FractionalZener(g0_pa=1e5, ginf_pa=1e7, tau_s=1e-3, alpha=0.9), 2, 5.0)
    assert first.eigenvalue == pytest.approx(4e5)
    assert second.eigenvalue.real > 4e5


def test_a_change_is_added_and_damping_multiplied():
    one = np.eye(2)
    system = SimpleNamespace(K_0=one, K_1=one, M=one, U=one[:, :1], d=np.array([3.0]))
    system.viscous = partial(EnrichedReducedPlate.viscous, system)
    A = ModalMatrices.of(system, Change(K=1j * one, M=0.5 * one, C=0.1 * one, damping=2.0))
    np.testing.assert_array_equal(A.stiffness(2.0, 10.0), np.diag([3 + 62j, 3 + 2j]))
    np.testing.assert_array_equal(A.M, 1.5 * one)


def test_a_stiffness_that_is_lost_on_the_way_leaves_no_modes():
    near_hz = 5.0

    class Sudden:
        def modulus(self, omega):
            return np.where(np.abs(omega / (2 * np.pi * near_hz) - 1) < 1e-9, 1e6, -1e9) + 0j

    assert modes_of(matrices(6), Sudden(), 3, near_hz) == []
