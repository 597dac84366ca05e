"""A few frequencies that stand for all of a sweep's: what an effect changes is smooth between them.

A change of the plate moves poles: near one the response changes as 1/(w^2 - p^2)^2. Times that, it is smooth.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Places, as_slice
from fitting.sweep import segments_by_gap

HZ_A_NODE = 4.0
"""Of wide clusters: 10 nodes leave 2e-4 over a segment of 30 to 50 Hz (decision 16); wider ones keep pace."""
_MOST = 2.4
"""Times the least number of nodes: with the poles out, 24 leave 1e-4 over clusters of 80 to 200 Hz too."""
_AT_A_NODE = 1e-9
"""Relative distance within which a place is a node itself: the formula would divide by it."""
MOST_POLES = 4
"""Taken out of a cluster: those in it and one on either side; more make the weights lose digits."""
_FARTHEST, _LEAST_DAMPED = 0.4, 0.25
"""A pole followed further than this from the unchanged one, or losing more of its damping (relative), is
another mode's."""


@dataclass(frozen=True)
class _Cluster:
    """Places of what belongs to a cluster of frequencies."""

    nodes: Places
    points: Places
    poles: NDArray[np.intp]
    plain: Complex
    """Shape (points, nodes)."""
    squares: Array
    """Of the frequencies of its nodes, then of its points, rad^2/s^2. Shape (nodes + points,)."""


@dataclass(frozen=True)
class Nodes:
    """Chebyshev points of every cluster of frequencies."""

    omega: Array
    """rad/s, ascending. Shape (nodes,)."""
    points: Array
    """rad/s, as the sweep has them. Shape (points,)."""
    plain: Array
    """Interpolates what has no poles. Shape (points, nodes)."""
    cluster: NDArray[np.intp]
    """Number of each node's cluster. Shape (nodes,)."""
    poles: Complex
    """Of the unchanged plate in and near the clusters, rad/s. Shape (poles,)."""
    pole_node: NDArray[np.intp]
    """The node nearest to each pole."""

    @classmethod
    def of(
        cls,
        omega: Array,
        least: int,
        *,
        cuts: Array | None = None,
        hz_a_node: float = HZ_A_NODE,
    ) -> "Nodes":
        """At least `least` nodes a cluster, more where it is wide; no more than it has frequencies.

        `cuts` (rad/s, ascending, shape (any,)) part clusters that hold more poles than can be taken out.
        """
        numbers = segments_by_gap(omega / (2 * np.pi))
        if cuts is not None and len(cuts):
            numbers = np.unique(
                np.stack([numbers, np.searchsorted(cuts, omega)]), axis=1, return_inverse=True
            )[1]
        nodes, clusters = [], []
        plain = np.zeros((len(omega), 0))
        for number in np.unique(numbers):
            inside = numbers == number
            known = np.unique(omega[inside])
            wanted = max(least, least // 2 + int(np.ptp(known) / (2 * np.pi * hz_a_node)))
            wanted = min(wanted, int(_MOST * least))
            at = known if len(known) <= wanted else _chebyshev(known[0], known[-1], wanted)
            block = np.zeros((len(omega), len(at)))
            block[inside] = _interpolation(at, omega[inside])
            plain = np.hstack([plain, block])
            nodes.append(at)
            clusters.append(np.full(len(at), number))
        none = np.empty(0, dtype=np.intp)
        return cls(
            np.concatenate(nodes),
            omega,
            plain,
            np.concatenate(clusters),
            np.empty(0, complex),
            none,
        )

    def around(self, poles: Callable[[float, float], Complex]) -> "Nodes":
        """The same, made for a plate whose poles near two frequencies (rad/s) are known.

        `poles` gives shape (any,).
        """
        found, nearest = [], []
        for number in np.unique(self.cluster):
            here = np.flatnonzero(self.cluster == number)
            if self._hits(here):
                # Every frequency is a node: there is nothing to interpolate.
                continue
            for p in poles(float(self.omega[here[0]]), float(self.omega[here[-1]])):
                found.append(p)
                nearest.append(here[np.argmin(np.abs(self.omega[here] - p.real))])
        return replace(
            self,
            poles=np.array(found, complex),
            pole_node=np.array(nearest, dtype=np.intp),
        )

    def _hits(self, here: NDArray[np.intp]) -> bool:
        """Whether a cluster's points are its nodes."""
        block = self.plain[:, here]
        return bool(np.all((block == 0) | (block == 1)))

    def slope(self, values: Complex) -> Complex:
        """d/d omega at the nodes of the poles. Shape (nodes,) to (poles,)."""
        before, after = self._neighbours
        return np.asarray((values[after] - values[before]) / (self.omega[after] - self.omega[before]))

    def spread(self, values: Complex, first: Complex, second: Complex) -> Complex:
        """From nodes to points of what has two sets of poles.

        Shapes (..., nodes) to (..., points).
        """
        poles = self._near(first, self.poles)
        moved = self._near(second, poles)
        p, q = poles[:, None] ** 2, moved[:, None] ** 2
        # Times what is one over it: complex numbers divide slowly.
        per_size = 1 / np.abs(poles)[:, None] ** 4
        found = np.zeros((*values.shape[:-1], len(self.points)), complex)
        for c in self._clusters:
            # (w^2 - p^2) (w^2 - p'^2) over |p|^4 for its every pole.
            mine = c.poles
            at = ((c.squares - p[mine]) * (c.squares - q[mine]) * per_size[mine]).prod(axis=0)
            weighted = values[..., c.nodes] * at[: c.plain.shape[1]]
            found[..., c.points] = (weighted @ c.plain.T) * (1 / at[c.plain.shape[1] :])
        return found

    def away(
        self, squares: Callable[[NDArray[np.intp], Places], Complex], *, at_nodes: bool = False
    ) -> Array:
        """|w^2 - p^2| over |p|^2 of each cluster's poles, multiplied: at its points, or at its nodes.

        `squares` gives those of some poles, by their numbers, as they have moved for some places. Shape
        (..., poles, places), or (poles, 1) where they are the same for all, to (..., points) or (nodes,).
        """
        found = np.ones(len(self.omega if at_nodes else self.points))
        size = np.abs(self.poles) ** 2
        for c in self._clusters:
            count = c.plain.shape[1]
            places, w = (c.nodes, c.squares[:count]) if at_nodes else (c.points, c.squares[count:])
            p = squares(c.poles, places)
            # Parts by themselves: complex numbers multiply slowly.
            away = np.sqrt(((w - p.real) ** 2 + p.imag**2).prod(axis=-2)) / size[c.poles].prod()
            if away.ndim > found.ndim:
                found = np.ones((*away.shape[:-1], len(found)))
            found[..., places] = away
        return found

    @cached_property
    def _neighbours(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The nodes before and after each pole's, of the same cluster."""
        at, n = self.pole_node, len(self.omega)
        before, after = np.maximum(at - 1, 0), np.minimum(at + 1, n - 1)
        same = [self.cluster[k] == self.cluster[at] for k in (before, after)]
        return np.where(same[0], before, at), np.where(same[1], after, at)

    @cached_property
    def _clusters(self) -> list["_Cluster"]:
        found = []
        for number in np.unique(self.cluster):
            here = np.flatnonzero(self.cluster == number)
            inside = np.flatnonzero(np.abs(self.plain[:, here]).sum(axis=1) > 0)
            mine = np.flatnonzero(self.cluster[self.pole_node] == number)
            plain = self.plain[np.ix_(inside, here)].astype(complex)
            squares = np.concatenate([self.omega[here], self.points[inside]]) ** 2
            found.append(_Cluster(as_slice(here), as_slice(inside), mine, plain, squares))
        return found

    def _near(self, moved: Complex, otherwise: Complex) -> Complex:
        # Where two modes overlap the estimate may be of neither; then the unchanged pole serves twice.
        far = np.abs(moved - self.poles) > _FARTHEST * np.abs(self.poles)
        lost = far | (moved.imag < _LEAST_DAMPED * self.poles.imag)
        return np.where(lost, otherwise, moved)


def _chebyshev(low: float, high: float, count: int) -> Array:
    t = -np.cos(np.pi * np.arange(count) / (count - 1))
    return np.asarray((low + high) / 2 + (high - low) / 2 * t)


def _interpolation(nodes: Array, at: Array) -> Array:
    """Lagrange's polynomials by the barycentric formula; linear where the nodes are few and anyhow."""
    if len(nodes) == 1:
        return np.ones((len(at), 1))
    scale = 4 / np.ptp(nodes)
    gaps = (nodes[:, None] - nodes) * scale
    np.fill_diagonal(gaps, 1.0)
    weight = 1 / gaps.prod(axis=1)
    distance = at[:, None] - nodes
    exact = np.abs(distance) < _AT_A_NODE * np.abs(nodes)
    distance[exact] = 1.0
    terms = weight / distance
    hit = exact.any(axis=1)
    terms[hit] = exact[hit]
    return np.asarray(terms / terms.sum(axis=1, keepdims=True))
