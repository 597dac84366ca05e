"""Poles p of (K_0 + G(p) K_1 + i p C_1 - p^2 M) y = 0, followed to where something has moved them.

Of two that are close Rayleigh's quotient by itself may go from one to the other. So all of a cluster are
followed together first, in what their modes span: there no two of them can become one.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from fitting.arrays import Array, Complex
from fitting.dynamics.dynamic_stiffness import Matrices, dynamic_stiffness

_STEPS = 1
"""Of Rayleigh's quotient, from what the known modes make of it."""
_OFF = 1e-9
"""Beside a pole, so that there is something to solve."""


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
        """On other columns, the first of its own among them. Shape (columns,)."""
        modes = np.zeros((len(self.at), len(own)), complex)
        modes[:, own] = self.modes[:, : np.count_nonzero(own)]
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
        K_0, K_1, M, C_1 = self.modes @ moved @ self.modes.T
        still, slope = self.modulus.G - self.modulus.slope * self.modulus.omega, self.modulus.slope
        # Each by itself first: most are alone.
        a, b, c, d = (np.diagonal(one) for one in (K_0, K_1, M, C_1))
        p, y = _forward(a + still * b, slope * b + 1j * d, c), self.modes.copy()
        for number in np.flatnonzero(np.bincount(self.cluster) > 1):
            mine = np.flatnonzero(self.cluster == number)
            here, middle = np.ix_(mine, mine), mine[len(mine) // 2]
            A = K_0[here] + still[middle] * K_1[here]
            found, s = _quadratic(A, slope[middle] * K_1[here] + 1j * C_1[here], M[here])
            was, now = linear_sum_assignment(np.abs(self.at[mine][:, None] - found))
            p[mine[was]], y[mine[was]] = found[now], s[now] @ self.modes[mine]
        return p, y


def _forward(a: Complex, b: Complex, c: Complex) -> Complex:
    """The p of a + p b - p^2 c = 0 that goes forward. Shape (any,)."""
    half, root = b / (2 * c), np.sqrt(b**2 + 4 * a * c) / (2 * c)
    return np.asarray(half + np.where(root.real < 0, -root, root))


def _quadratic(A: Complex, B: Complex, C: Complex) -> tuple[Complex, Complex]:
    """Of (A + p B - p^2 C) s = 0 those p that go forward, and their s as rows.

    Shapes (m, m) to (m,) and (m, m).
    """
    m = len(A)
    companion = np.zeros((2 * m, 2 * m), complex)
    companion[range(m), range(m, 2 * m)] = 1.0
    companion[m:] = np.linalg.solve(C, np.concatenate([A, B], axis=1))
    values, vectors = np.linalg.eig(companion)
    forward = np.argsort(values.real)[m:]
    return values[forward], np.asarray(vectors[:m, forward].T)


def _rayleigh_iterated(
    moved: Matrices, y: Complex, p: Complex, modulus: ModulusNear
) -> tuple[Complex, Complex]:
    """Better p and y by Rayleigh's quotient iteration from guesses. Shapes (poles,) and (poles, k)."""
    energies, forces = _energies(moved, y)
    for _ in range(_STEPS):
        square = _rayleigh(energies, p, modulus) * (1 + _OFF)
        A = dynamic_stiffness(moved, p, modulus.at(p), square)
        turned = np.linalg.solve(A, forces[2][:, :, None])[:, :, 0]
        y = np.asarray(turned / np.linalg.norm(turned, axis=1)[:, None], dtype=complex)
        energies, forces = _energies(moved, y)
        p = np.sqrt(_rayleigh(energies, p, modulus))
    return np.sqrt(_rayleigh(energies, p, modulus)), y


def _energies(moved: Matrices, y: Complex) -> tuple[Complex, Complex]:
    """Y^T N y and N y of each of the matrices.

    Shapes (4, k, k) and (poles, k) to (4, poles) and (4, poles, k).
    """
    forces = y @ moved
    return (forces * y).sum(axis=2), forces


def _rayleigh(energies: Complex, p: Complex, modulus: ModulusNear) -> Complex:
    """p^2 as the modes have it, what depends on p being as there."""
    K_0, K_1, M, C_1 = energies
    return np.asarray((K_0 + modulus.at(p) * K_1 + 1j * p * C_1) / M)
