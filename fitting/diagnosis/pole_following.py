"""Poles p of (K_0 + G(p) K_1 + i p C_1 - p^2 M) y = 0, followed to where something has moved them.

Of two that are close Rayleigh's quotient by itself may go from one to the other. So all of a cluster are
followed together first, in what their modes span: there no two of them can become one.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from fitting.arrays import Array, Complex

_STEPS = 1
"""Of Rayleigh's quotient, from what the known modes make of it."""
_OFF = 1e-9
"""Beside a pole, so that there is something to solve."""

Matrices = tuple[Complex, Array, Array, Array]
"""K_0, K_1, M and C_1. Shape (k, k) each."""


@dataclass(frozen=True)
class ModulusNear:
    """G* near some frequencies, off the real axis too: to first order."""

    omega: Array
    G: Complex
    slope: Complex
    """dG/d omega, Pa s."""

    def at(self, p: Complex) -> Complex:
        """At p near the frequency of the same place. Shape of `omega`."""
        return np.asarray(self.G + self.slope * (p - self.omega))


@dataclass(frozen=True)
class KnownPoles:
    """Poles of a plate, to be followed."""

    at: Complex
    """rad/s. Shape (poles,)."""
    modes: Complex
    """Shape (poles, k)."""
    cluster: NDArray[np.intp]
    """Number of what each is followed with. Shape (poles,)."""
    modulus: ModulusNear
    """Near each, after the move."""

    def on(self, own: NDArray[np.bool_]) -> "KnownPoles":
        """On more columns, its own among them. Shape (columns,)."""
        modes = np.zeros((len(self.at), len(own)), complex)
        modes[:, own] = self.modes
        return replace(self, modes=modes)

    def alike(self, other: "KnownPoles") -> bool:
        """Whether another follows the same under the same modulus."""
        mine, its = self.modulus, other.modulus
        pairs = [
            (self.at, other.at),
            (self.modes, other.modes),
            (self.cluster, other.cluster),
            (mine.omega, its.omega),
        ]
        return all(np.array_equal(a, b) for a, b in [*pairs, (mine.G, its.G), (mine.slope, its.slope)])

    def followed(self, moved: Matrices) -> tuple[Complex, Complex]:
        """Where they are with other matrices, rad/s, and their modes. Shapes of `at` and `modes`."""
        p, y = self._apart(moved)
        return _rayleigh_iterated(moved, y, p, self.modulus)

    def _apart(self, moved: Matrices) -> tuple[Complex, Complex]:
        """What the modes of each cluster make of it, by Ritz: (A + p B - p^2 C) s = 0."""
        K_0, K_1, M, C_1 = moved
        p, y = np.empty_like(self.at), np.empty_like(self.modes)
        for number in np.unique(self.cluster):
            mine = np.flatnonzero(self.cluster == number)
            omega, G, slope = (
                w[mine[len(mine) // 2]] for w in (self.modulus.omega, self.modulus.G, self.modulus.slope)
            )
            Y = self.modes[mine]
            A, B, C = (Y @ N @ Y.T for N in (K_0 + (G - slope * omega) * K_1, slope * K_1 + 1j * C_1, M))
            found, s = _quadratic(A, B, C)
            was, now = linear_sum_assignment(np.abs(self.at[mine][:, None] - found))
            p[mine[was]], y[mine[was]] = found[now], s[now] @ Y
        return p, y


def _quadratic(A: Complex, B: Complex, C: Complex) -> tuple[Complex, Complex]:
    """Of (A + p B - p^2 C) s = 0 those p that go forward, and their s as rows.

    Shapes (m, m) to (m,) and (m, m).
    """
    m = len(A)
    companion = np.vstack([np.eye(m, 2 * m, k=m), np.linalg.solve(C, np.hstack([A, B]))])
    values, vectors = np.linalg.eig(companion)
    forward = np.argsort(values.real)[m:]
    return values[forward], np.asarray(vectors[:m, forward].T)


def _rayleigh_iterated(
    moved: Matrices, y: Complex, p: Complex, modulus: ModulusNear
) -> tuple[Complex, Complex]:
    """Better p and y by Rayleigh's quotient iteration from guesses. Shapes (poles,) and (poles, k)."""
    M = moved[2]
    for _ in range(_STEPS):
        K = _stiffness(moved, p, modulus)
        My = y @ M
        square = _rayleigh(K, y, My)
        turned = np.linalg.solve(K - (square * (1 + _OFF))[:, None, None] * M, My[:, :, None])[:, :, 0]
        y = np.asarray(turned / np.linalg.norm(turned, axis=1)[:, None], dtype=complex)
        p = np.asarray(np.sqrt(_rayleigh(K, y, y @ M)), dtype=np.complex128)
    return np.asarray(np.sqrt(_rayleigh(_stiffness(moved, p, modulus), y, y @ M))), y


def _stiffness(moved: Matrices, p: Complex, modulus: ModulusNear) -> Complex:
    K_0, K_1, _, C_1 = moved
    G = modulus.at(p)
    return np.asarray(K_0 + G[:, None, None] * K_1 + (1j * p)[:, None, None] * C_1)


def _rayleigh(K: Complex, y: Complex, My: Complex) -> Complex:
    return np.asarray(((K @ y[:, :, None])[:, :, 0] * y).sum(axis=1) / (y * My).sum(axis=1))
