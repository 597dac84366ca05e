"""Clamped edges let go in some of their motions, whichever edges these are.

The held plate's answers condensed on them as in `fitting.widened.released_root`, which is the quicker way for
the root of a plate that is alike on both sides of its axis.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from fitting.arrays import Array, Complex, Indices
from fitting.numerics.linear import times
from fitting.plate.mesh import treated_nodes
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.released_root import ReleasedRoot, along_line

Axis = Literal["x", "y"]
Released = Mapping[Axis, Sequence[int]]
"""Degrees of freedom of a node that are let go, by the axis that an edge lies across."""

_MOST = 8
"""Polynomials along an edge, for each of a node's degrees of freedom."""
_ALIKE = 1e-8
"""Of the largest singular value: motions of the rim that are combinations of others."""


@dataclass(frozen=True)
class ClampedEdge:
    """A line of nodes."""

    across: Axis
    """x for an edge of constant x."""
    nodes: Indices
    step_m: float
    """From node to node."""


def clamped_edges(full: FullPlate) -> list[ClampedEdge]:
    """In the order of `fitting.stated.edges`."""
    mesh = full.loose.mesh
    node = np.arange(mesh.nodes).reshape(mesh.n_x + 1, mesh.n_y + 1)
    a, b = mesh.sides_m
    lines = (
        ClampedEdge("x", node[0], b),
        ClampedEdge("y", node[:, 0], a),
        ClampedEdge("x", node[-1], b),
        ClampedEdge("y", node[:, -1], a),
    )
    return [line for line, held in zip(lines, full.specimen.edges, strict=True) if held == "clamped"]


def rim_forces(full: FullPlate, at: Snapshot, released: Released) -> Complex:
    """What `released_rim` asks the held plate's answers to. Shape (n, any)."""
    return np.hstack([times(_dynamic(full, at), _moved(full, released)), full.loads])


def released_rim(full: FullPlate, at: Snapshot, released: Released, answers: Complex) -> ReleasedRoot:
    """The reduced rim of a plate whose edge is released there.

    `answers` are those of the held plate to `rim_forces`. Shape (n, any).
    """
    E = _moved(full, released)
    follow, held = answers[:, : E.shape[1]], answers[:, E.shape[1] :]
    T = E - follow
    rim = np.flatnonzero(np.any(E, axis=1))
    return ReleasedRoot(rim, T, E.T @ times(_dynamic(full, at), T), T.T @ full.loads, held)


def on_edge(full: FullPlate, edge: ClampedEdge, local: Array, weight: Array | None = None) -> sp.csc_array:
    """A stiffness per length of an edge, on the loose plate, by a node's motions.

    `local` of shape (dofs, dofs) at most. `weight` is given at the nodes, linear between them.
    """
    mesh = full.loose.mesh
    along = along_line(len(edge.nodes) - 1, edge.step_m, weight)
    block = sp.kron(along, np.pad(local, (0, mesh.dofs - len(local)))).tocoo()
    place = (edge.nodes[:, None] * mesh.dofs + np.arange(mesh.dofs)).ravel()
    whole = sp.coo_array((block.data, (place[block.row], place[block.col])), (mesh.size,) * 2).tocsr()
    return sp.csc_array(whole[full.loose.free][:, full.loose.free])


def treated_along(full: FullPlate, edge: ClampedEdge) -> Array | None:
    """One where the treatment reaches an edge, else zero; None: all along. Shape (nodes of the edge,)."""
    if not full.specimen.patches:
        return None
    return treated_nodes(full.specimen, full.loose.mesh)[edge.nodes].astype(float)


def _dynamic(full: FullPlate, at: Snapshot) -> sp.csr_array:
    loose = full.loose
    return sp.csr_array(loose.K_0 + at.G * loose.K_1 - at.omega**2 * loose.M)


def _moved(full: FullPlate, released: Released) -> Array:
    """Motions of the rim, smooth along each edge, independent; even in y where no others are stirred.

    Shape (n, few).
    """

    def make() -> Array:
        E = np.hstack([_along_edge(full, edge, released[edge.across]) for edge in clamped_edges(full)])
        if full.only_even:
            E = times(full.loose.even, times(sp.csr_array(full.loose.even.T), E))
        rim = np.flatnonzero(np.any(E, axis=1))
        U, s, _ = la.svd(E[rim], full_matrices=False)
        found = np.zeros((len(E), int(np.sum(s > _ALIKE * s[0]))))
        found[rim] = U[:, : found.shape[1]]
        return found

    return full.once(f"motions of the rim {sorted(released.items())}", make)


def _along_edge(full: FullPlate, edge: ClampedEdge, dofs: Sequence[int]) -> Array:
    """Legendre's polynomials along an edge, of what the plate has there. Shape (n, few)."""
    count = min(_MOST, len(edge.nodes))
    L = np.polynomial.legendre.legvander(np.linspace(-1, 1, len(edge.nodes)), count - 1)
    every = np.zeros((full.loose.mesh.size, len(dofs) * count))
    for k, dof in enumerate(dofs):
        every[edge.nodes * full.loose.mesh.dofs + dof, k * count : (k + 1) * count] = L
    return every[full.loose.free]
