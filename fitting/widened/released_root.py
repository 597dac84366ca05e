"""The root let go in some of its motions: the held plate's answers condensed on them.

With r the released motions of the root and i all that the clamp leaves free,

    T = E_r - A_ii^-1 A_ir,   (T^T A T + S) y = T^T f,   x = A_ii^-1 f_i + T y

so one factorisation of the held plate serves every spring S at the root. Its motions are smooth along y:
a few polynomials do.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Indices
from fitting.numerics.linear import times
from fitting.widened.full_plate import FullPlate, Snapshot

_PAIRS = 5
"""Of an even and an odd polynomial along the root, for each of a node's degrees of freedom."""


@dataclass(frozen=True)
class ReleasedRoot:
    """A point of frequency and modulus; r released motions."""

    root: Indices
    """Released degrees of freedom of the loose plate."""
    T: Complex
    """Responses to the released motions. Shape (n, r)."""
    stiffness: Complex
    """T^T A T. Shape (r, r)."""
    forces: Complex
    """T^T f for a unit base acceleration and a unit force at the pickup. Shape (r, 2)."""
    held: Complex
    """Responses of the held plate to the same. Shape (n, 2)."""

    def answers(self, full: FullPlate, springs: Iterable[sp.sparray]) -> Complex:
        """Responses on springs at the root, of unit size. Shape (n, 2 springs)."""
        T, found = self.T[self.root], []
        for each in springs:
            S = T.T @ times(sp.csr_array(each)[self.root][:, self.root], T)
            found.append(np.linalg.solve(self.stiffness + S, self.forces))
        return full.unit(np.tile(self.held, len(found)) + self.T @ np.hstack(found))


def root_forces(full: FullPlate, at: Snapshot, dofs: Sequence[int]) -> Complex:
    """What `released` asks the held plate's answers to. Shape (n, any)."""
    return np.hstack([_beside_root(full, at, dofs) @ _moved(full, dofs), full.loads])


def released(
    full: FullPlate, at: Snapshot, dofs: Sequence[int], answers: Complex, *, odd: bool
) -> ReleasedRoot:
    """The root released in some of a node's degrees of freedom; `odd` for motions odd in y too.

    `answers` are those of the held plate to `root_forces`. Shape (n, any).
    """
    root, moved = root_dofs(full, dofs), _moved(full, dofs)
    # An even and an odd motion in one column: its response and the mirrored one tell them apart.
    follow, held = answers[:, : moved.shape[1]], answers[:, moved.shape[1] :]
    E = np.zeros((full.loose.size, moved.shape[1]))
    E[root] = moved
    if odd:
        F = E - follow
        G = _mirrored(full, F)
        T = np.hstack([F + G, F - G])
    else:
        T = E + _mirrored(full, E) - 2 * follow
    beside = sp.csr_array(_beside_root(full, at, dofs).T)
    return ReleasedRoot(root, T, T[root].T @ (beside @ T), T.T @ full.loads, held)


def _moved(full: FullPlate, dofs: Sequence[int]) -> Array:
    """Motions of the root, smooth along y. Shape (released, few)."""
    smooth = np.kron(_along(full.loose.mesh.n_y + 1), np.eye(len(dofs)))
    there = smooth[_is_there(full, _of_root(full, dofs))]
    return np.asarray(there[:, np.any(there, axis=0)], dtype=float)


def _beside_root(full: FullPlate, at: Snapshot, dofs: Sequence[int]) -> sp.csr_array:
    """Columns of the dynamic stiffness at the root. Shape (n, released)."""

    def make() -> list[sp.csr_array]:
        root = root_dofs(full, dofs)
        return [sp.csr_array(A[:, root]) for A in (full.loose.K_0, full.loose.K_1, full.loose.M)]

    K_0, K_1, M = full.once(f"beside the root {dofs}", make)
    return sp.csr_array(K_0 + at.G * K_1 - at.omega**2 * M)


def _along(nodes: int) -> Array:
    """Legendre's polynomials at the root's nodes, each even one plus the next odd one. Shape (nodes, few)."""
    count = min(2 * _PAIRS, nodes // 2 * 2)
    L = np.polynomial.legendre.legvander(np.linspace(-1, 1, nodes), count - 1)
    return np.asarray(L[:, 0::2] + L[:, 1::2])


def _mirrored(full: FullPlate, X: Array | Complex) -> Array | Complex:
    """Motions of the loose plate seen in the mirror y to width - y."""

    def make() -> tuple[sp.csr_array, sp.csr_array]:
        P = full.loose.even
        return sp.csr_array(P), sp.csr_array(P.T)

    up, down = full.once("even motions", make)
    return np.asarray(2 * times(up, times(down, X)) - X)


def root_dofs(full: FullPlate, dofs: Sequence[int]) -> Indices:
    """Places of the root nodes' degrees of freedom among the loose plate's. Shape (dofs it has,)."""
    wanted = _of_root(full, dofs)
    there = wanted[_is_there(full, wanted)]
    return np.asarray(np.searchsorted(full.loose.free, there), dtype=np.intp)


def _of_root(full: FullPlate, dofs: Sequence[int]) -> Indices:
    nodes = np.arange(full.loose.mesh.n_y + 1)
    return np.asarray((nodes[:, None] * full.loose.mesh.dofs + np.asarray(dofs)).ravel(), dtype=np.intp)


def _is_there(full: FullPlate, wanted: Indices) -> NDArray[np.bool_]:
    """Layers that do not stretch, and treatment that is not there, have no motion. Shape of `wanted`."""
    return np.isin(wanted, full.loose.free)


def along_root(full: FullPlate, weight: Array | None = None) -> sp.csr_array:
    """Integral along y of two of the root's linear shape functions, in m. Shape (n_y + 1, n_y + 1).

    `weight` is given at the nodes, linear between them.
    """
    return along_line(full.loose.mesh.n_y, full.loose.mesh.sides_m[1], weight)


def along_line(count: int, step_m: float, weight: Array | None) -> sp.csr_array:
    """As `along_root`, of a line of `count` elements of length `step_m`. Shape (count + 1, count + 1)."""
    g = np.ones(count + 1) if weight is None else weight
    low, high = g[:-1], g[1:]
    diagonal = np.zeros(count + 1)
    diagonal[:-1] += step_m * (low / 4 + high / 12)
    diagonal[1:] += step_m * (low / 12 + high / 4)
    beside = step_m * (low + high) / 12
    return sp.csr_array(sp.diags_array([beside, diagonal, beside], offsets=[-1, 0, 1]))


def on_root(full: FullPlate, along: sp.sparray, local: Array) -> sp.csc_array:
    """A stiffness per area of the root, or per width, on the loose plate, by a node's motions.

    `local` of shape (dofs, dofs) at most.
    """
    n, dofs = full.loose.mesh.size, full.loose.mesh.dofs
    block = sp.kron(along, np.pad(local, (0, dofs - len(local)))).tocoo()
    whole = sp.coo_array((block.data, (block.row, block.col)), (n, n)).tocsr()
    return sp.csc_array(whole[full.loose.free][:, full.loose.free])
