"""The sweep as a rational sum in G*: the whole response of one specimen on one frequency grid.

At a fixed frequency the response depends on G* alone. With A(G) = A_ref + (G - G_ref) K_1 and the
eigenpairs of A_ref^-1 K_1,

    x(G) = sum_k c_k / (1 + (G - G_ref) mu_k)

so a law costs one sum a frequency, and its derivative as little. All moduli of the domain are spanned by
the responses at a few of them, so that the sum has about half as many terms as the reduced plate has vectors.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.arrays import Array, Complex
from fitting.progress import Report, unheard
from fitting.reduced.reduced_plate import ReducedPlate

NODES_A_DECADE = 4
"""Moduli a decade at which the sum is spanned; it then agrees with the reduced plate to 1e-8 or better."""
_NODE_ANGLE = 0.5
"""Their argument in rad: lossy enough to be off the resonances, near enough to see them."""
_PARTS, _MOST_AT_ONCE = 8, 512
"""Of a grid, worked on two at a time; a part's matrices lie in memory together, 100 kB a frequency."""


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
    _latest: dict[bytes, tuple[Complex, Complex]] = field(
        default_factory=dict, init=False, compare=False, repr=False
    )
    """By the modulus, of one law: many effects are looked at beside it."""

    def displacement(self, G: Complex) -> Complex:
        """x(G). `G` of shape (points,), or (laws, points) for many laws at once; so the result."""
        q = 1 / (1 + (np.asarray(G) - self.G_ref)[..., None] * self.mu)
        return np.asarray(np.einsum("...pk,pk->...p", q, self.c))

    def with_derivative(self, G: Complex) -> tuple[Complex, Complex]:
        """x(G) and dx/dG, of the shape of `G` each: (points,), or (laws, points)."""
        if G.ndim > 1:
            return self._with_derivative(G)
        key = G.tobytes()
        if key not in self._latest:
            self._latest.clear()
            self._latest[key] = self._with_derivative(G)
        return self._latest[key]

    def _with_derivative(self, G: Complex) -> tuple[Complex, Complex]:
        q = 1 / (1 + (np.asarray(G) - self.G_ref)[..., None] * self.mu)
        cq = self.c * q
        return cq.sum(axis=-1), -np.einsum("...pk,...pk,pk->...p", cq, q, self.mu)

    def at(self, index: NDArray[np.intp]) -> "RationalSweep":
        """The same sum at some of the frequencies. Shape (n,)."""
        return RationalSweep(self.omega[index], self.G_ref, self.c[index], self.mu[index])


def rational_sweep(plate: ReducedPlate, omega: Array, progress: Report = unheard) -> RationalSweep:
    """Diagonalise the reduced plate at each frequency of `omega` (rad/s, shape (points,))."""
    return rational_sweeps(plate, omega, progress).of(0, 1)


@dataclass(frozen=True)
class RationalSweeps:
    """The same between any two of a reduced plate's `sides`."""

    omega: Array
    G_ref: complex
    c: Complex
    """Driven at one and read at another of them. Shape (driven, read, points, terms)."""
    mu: Complex

    def of(self, driven: int, read: int) -> RationalSweep:
        """Between two of them."""
        return RationalSweep(self.omega, self.G_ref, self.c[driven, read], self.mu)


def rational_sweeps(plate: ReducedPlate, omega: Array, progress: Report = unheard) -> RationalSweeps:
    """Diagonalise the reduced plate at each frequency of `omega` (rad/s, shape (points,)).

    Driven at the load alone where there are no further spots.
    """
    size = np.sqrt(plate.domain.modulus[0] * plate.domain.modulus[1])
    # A lossy reference: A_ref is then far from every resonance.
    G_ref = complex(size * (1 + 1j) / np.sqrt(2))
    count = max(1, min(len(omega), _PARTS), -(-len(omega) // _MOST_AT_ONCE))
    parts = np.array_split(np.asarray(omega, dtype=float), count)
    done = []
    with threadpool_limits(1, "blas"), ThreadPoolExecutor(2) as pool:
        for part in pool.map(lambda part: _diagonalise(plate, part, G_ref), parts):
            done.append(part)
            progress(len(done) / len(parts))
    c = np.concatenate([d[0] for d in done], axis=2)
    mu = np.concatenate([d[1] for d in done])
    return RationalSweeps(np.asarray(omega, dtype=float), G_ref, c, mu)


def _diagonalise(plate: ReducedPlate, omega: Array, G_ref: complex) -> tuple[Complex, Complex]:
    """Terms c and mu at each frequency, in the span of responses at a few moduli."""
    W = _span(plate, omega)
    Wt = W.transpose(0, 2, 1)
    # A is complex symmetric: transposes, not conjugates, keep the error quadratic.
    A = Wt @ plate.matrices(omega, np.full(len(omega), G_ref)) @ W
    K_1 = Wt @ (plate.K_1 @ W)
    sides = [Wt @ side for side in plate.sides]
    driven = sides if len(plate.further) else sides[:1]
    solved = np.linalg.solve(A, np.concatenate([K_1, *(side[:, :, None] for side in driven)], axis=2))
    mu, Y = np.linalg.eig(solved[:, :, : -len(driven)])
    weights = np.linalg.solve(Y, solved[:, :, -len(driven) :])
    rows = [np.einsum("pk,pkm->pm", side, Y) for side in sides]
    return np.array([[row * weights[:, :, k] for row in rows] for k in range(len(driven))]), mu


def _span(plate: ReducedPlate, omega: Array) -> Complex:
    """Responses to all `sides` at moduli over the domain, orthonormal. Shape (points, k, vectors)."""
    low, high = plate.domain.modulus
    count = max(1, int(np.ceil(NODES_A_DECADE * np.log10(high / low))))
    moduli = np.geomspace(low, high, count) * np.exp(1j * _NODE_ANGLE)
    sides = plate.sides.T.astype(complex)
    both = np.broadcast_to(sides, (len(omega), *sides.shape))
    found = [np.linalg.solve(plate.matrices(omega, np.full(len(omega), g)), both) for g in moduli]
    whole = np.concatenate(found, axis=2)
    # A domain wider than the basis is deep spans all of it.
    Q: Complex = np.linalg.qr(whole)[0].astype(complex, copy=False)
    return Q
