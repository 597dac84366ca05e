"""The sweep as a rational sum in G*: the whole response of one specimen on one frequency grid.

At a fixed frequency the response depends on G* alone. With A(G) = A_ref + (G - G_ref) K_1 and the
eigenpairs of A_ref^-1 K_1,

    x(G) = sum_k c_k / (1 + (G - G_ref) mu_k)

so a law costs one sum a frequency, and its derivative as little.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.reduced import ReducedPlate

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

NEGLIGIBLE = 1e-12
"""Terms that never contribute this fraction of the response anywhere in the domain are dropped."""


@dataclass(frozen=True)
class RationalSweep:
    """Relative displacement at the pickup per base acceleration, s^2, on a grid of frequencies."""

    omega: Array
    """rad/s. Shape (points,)."""
    G_ref: complex
    c: Complex
    """m per m/s^2. Shape (points, terms)."""
    mu: Complex
    """1/Pa. Shape (points, terms)."""

    def displacement(self, G: Complex) -> Complex:
        """x(G). `G` of shape (points,), or (laws, points) for many laws at once; so the result."""
        q = 1 / (1 + (np.asarray(G) - self.G_ref)[..., None] * self.mu)
        return np.asarray(np.einsum("...pk,pk->...p", q, self.c))

    def with_derivative(self, G: Complex) -> tuple[Complex, Complex]:
        """x(G) and dx/dG. Shape (points,) each."""
        q = 1 / (1 + (np.asarray(G) - self.G_ref)[:, None] * self.mu)
        cq = self.c * q
        return cq.sum(axis=1), -np.einsum("pk,pk,pk->p", cq, q, self.mu)

    def at(self, index: NDArray[np.intp]) -> "RationalSweep":
        """The same sum at some of the frequencies."""
        return RationalSweep(self.omega[index], self.G_ref, self.c[index], self.mu[index])


def rational_sweep(
    plate: ReducedPlate, omega: Array, progress: Callable[[float], None] = lambda fraction: None
) -> RationalSweep:
    """Diagonalise the reduced plate at each frequency of `omega` (rad/s, shape (points,))."""
    size = np.sqrt(plate.domain.modulus[0] * plate.domain.modulus[1])
    # A lossy reference: A_ref is then far from every resonance.
    G_ref = complex(size * (1 + 1j) / np.sqrt(2))
    parts = np.array_split(np.asarray(omega, dtype=float), max(1, min(len(omega), 8)))
    done = []
    with threadpool_limits(1, "blas"), ThreadPoolExecutor(2) as pool:
        for part in pool.map(lambda part: _diagonalise(plate, part, G_ref), parts):
            done.append(part)
            progress(len(done) / len(parts))
    c = np.concatenate([d[0] for d in done])
    mu = np.concatenate([d[1] for d in done])
    keep = _contributing(plate, c, mu, G_ref)
    return RationalSweep(np.asarray(omega, dtype=float), G_ref, c[:, keep], mu[:, keep])


def _diagonalise(plate: ReducedPlate, omega: Array, G_ref: complex) -> tuple[Complex, Complex]:
    A = plate.matrices(omega, np.full(len(omega), G_ref))
    K_1 = np.broadcast_to(plate.K_1, A.shape)
    right = np.concatenate([K_1, np.broadcast_to(plate.load[:, None], (*A.shape[:2], 1))], axis=2)
    solved = np.linalg.solve(A, right.astype(complex))
    mu, Y = np.linalg.eig(solved[:, :, :-1])
    weights = np.linalg.solve(Y, solved[:, :, -1:])[:, :, 0]
    c = np.einsum("k,pkm->pm", plate.observe, Y) * weights
    order = np.argsort(-np.abs(mu), axis=1)
    return np.take_along_axis(c, order, 1), np.take_along_axis(mu, order, 1)


def _contributing(plate: ReducedPlate, c: Complex, mu: Complex, G_ref: complex) -> NDArray[np.bool_]:
    """Columns that matter somewhere in the domain."""
    keep = np.zeros(c.shape[1], dtype=bool)
    for t in np.linspace(0, 1, 7):
        for u in (0.0, 0.5, 1.0):
            G = plate.domain.point(0, float(t), u)[1]
            term = c / (1 + (G - G_ref) * mu)
            share = np.abs(term) / np.abs(term.sum(axis=1, keepdims=True))
            keep |= share.max(axis=0) > NEGLIGIBLE
    return keep
