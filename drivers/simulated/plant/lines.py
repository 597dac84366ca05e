"""Piecewise polynomials along one axis: Lagrange's, on Gauss and Lobatto's points of each piece.

A solid on a tensor grid is made of them: its integrals are products of integrals along the axes.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.polynomial import Legendre
from numpy.polynomial.legendre import legvander

from drivers.arrays import Array


@dataclass(frozen=True)
class Sampled:
    """Polynomials at the Gauss points of all pieces."""

    x: Array
    """Shape (points,)."""
    weight: Array
    """Shape (points,)."""
    values: sp.csr_array
    """Shape (points, nodes)."""
    slopes: sp.csr_array
    """The same of the derivatives."""


@dataclass(frozen=True)
class Line:
    """One axis."""

    ends: tuple[float, ...]
    """Of the pieces, ascending."""
    order: int

    @cached_property
    def _points(self) -> Array:
        """Of a piece from -1 to 1, both its ends included."""
        inner = np.sort(Legendre.basis(self.order).deriv().roots().real)
        return np.concatenate([[-1.0], inner, [1.0]])

    @cached_property
    def nodes(self) -> Array:
        """Shape (nodes,)."""
        low, high = np.array(self.ends[:-1]), np.array(self.ends[1:])
        inside = low[:, None] + (high - low)[:, None] * (self._points[:-1] + 1) / 2
        return np.append(inside.ravel(), high[-1])

    @cached_property
    def sampled(self) -> Sampled:
        """With enough points for products of two polynomials, one of them times x."""
        t, weight = np.polynomial.legendre.leggauss(self.order + 2)
        inverse = np.linalg.inv(legvander(self._points, self.order))
        N = legvander(t, self.order) @ inverse
        each = [Legendre.basis(k).deriv()(t) for k in range(self.order + 1)]
        D = np.array(each).T @ inverse
        low, high = np.array(self.ends[:-1]), np.array(self.ends[1:])
        half, pieces = (high - low) / 2, len(low)
        q, k = len(t), self.order + 1
        rows = np.arange(pieces)[:, None, None] * q + np.arange(q)[:, None] + np.zeros(k, int)
        columns = np.arange(pieces)[:, None, None] * self.order + np.zeros((q, 1), int) + np.arange(k)
        shape = (pieces * q, len(self.nodes))

        def spread(local: Array) -> sp.csr_array:
            at = (rows.ravel(), columns.ravel())
            return sp.coo_array((np.broadcast_to(local, rows.shape).ravel(), at), shape=shape).tocsr()

        x = (low[:, None] + half[:, None] * (t + 1)).ravel()
        return Sampled(x, (half[:, None] * weight).ravel(), spread(N), spread(D / half[:, None, None]))

    def integral(
        self,
        first: int,
        second: int,
        only: tuple[float, float] | None = None,
        factor: Callable[[Array], Array] | None = None,
    ) -> sp.csr_array:
        """Of products of derivatives (0 or 1) of all polynomials, over all of it or a part.

        `factor` is a function of the place that they are weighted by. Shape (nodes, nodes).
        """
        s = self.sampled
        weight = s.weight if only is None else s.weight * ((s.x > only[0]) & (s.x < only[1]))
        weight = weight if factor is None else weight * factor(s.x)
        a, b = (s.slopes if d else s.values for d in (first, second))
        return (a.T @ sp.diags_array(weight) @ b).tocsr()

    def at(self, x: float) -> Array:
        """Values of all polynomials at a place. Shape (nodes,)."""
        k = min(max(int(np.searchsorted(self.ends, x, side="right")) - 1, 0), len(self.ends) - 2)
        low, high = self.ends[k], self.ends[k + 1]
        t = 2 * (x - low) / (high - low) - 1
        out = np.zeros(len(self.nodes))
        local = legvander(np.array([t]), self.order) @ np.linalg.inv(legvander(self._points, self.order))
        out[k * self.order : (k + 1) * self.order + 1] = local[0]
        return out
