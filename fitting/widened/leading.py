"""The leading motions of one parity that responses have beside known ones."""

from collections.abc import Sequence

import numpy as np
import scipy.linalg as la

from fitting.arrays import Array, Complex
from fitting.dynamics.half_plate import HalfPlate, Parity
from fitting.numerics.linear import times
from fitting.widened.full_plate import FullPlate

_ALIKE = 1e-14
"""Of the largest product, what is nothing but rounding."""
_MANY = 16
"""Motions that are worth condensing."""

Stirred = tuple[Array, Array]
"""Motions, and they by `FullPlate.scale`. Shape (half, any) each."""


class Motions:
    """Of the loose plate, of one parity or all, orthonormal by `FullPlate.scale` to the first; by group."""

    def __init__(self, full: FullPlate, parity: Parity) -> None:
        self.half = HalfPlate(full.loose, parity)
        self.scale = np.asarray(self.half.blocks(full.scale))
        self.groups: dict[str, Array] = {}

    def of(self, motions: Array) -> Array:
        """The part of some motions that belongs to this half. Shape (half, any)."""
        return np.asarray(self.half.down @ motions)

    def stirred(self, responses: Sequence[Complex]) -> list[Stirred]:
        """Of several spans: as few real motions each as have the same products, many being alike.

        Of responses of shape (n, any).
        """
        X = times(self.half.down, np.hstack(responses))
        ends = np.cumsum([r.shape[1] for r in responses])[:-1]
        each = [np.hstack([x.real, x.imag]) for x in np.split(X, ends, axis=1)]
        scaled = np.split(self._scaled(np.hstack(each)), 2 * ends, axis=1)
        return [self._condensed(x, s) for x, s in zip(each, scaled, strict=True)]

    def _condensed(self, X: Array, SX: Array) -> Stirred:
        if X.shape[1] < _MANY:
            return X, SX
        values, vectors = np.linalg.eigh(X.T @ SX)
        few = vectors[:, values > _ALIKE * values.max()]
        return X @ few, SX @ few

    def leading(
        self, responses: Sequence[Stirred], known: Array | None, tolerance: float, most: int
    ) -> Array:
        """Orthonormal motions that the responses have beside `known`. Shape (half, few)."""
        X, SX = (np.hstack(side) for side in zip(*responses, strict=True))
        if not X.shape[1]:
            return X
        products = X.T @ SX
        if known is None:
            known = np.empty((len(X), 0))
        inside = known.T @ SX
        products -= inside.T @ inside
        count = len(products)
        largest = (max(0, count - most), count - 1)
        values, vectors = la.eigh(products, subset_by_index=largest, check_finite=False)
        few = np.flatnonzero(values > tolerance**2)[::-1]
        weights = vectors[:, few] / np.sqrt(values[few])
        V = X @ weights - known @ (inside @ weights)
        return self.orthonormal(V - known @ (known.T @ self._scaled(V)))

    def orthonormal(self, V: Array) -> Array:
        """The same motions, orthonormal by `FullPlate.scale`. Shape (half, few), as `V`."""
        for _ in range(2):
            R = np.linalg.cholesky(V.T @ self._scaled(V))
            V = la.solve_triangular(R, V.T, lower=True).T
        return np.asarray(V)

    def _scaled(self, X: Array) -> Array:
        return np.asarray(self.half.chain.times(self.scale, X))

    @property
    def columns(self) -> Array:
        """All groups side by side. Shape (half, k)."""
        return np.hstack([*self.groups.values()])

    @property
    def names(self) -> list[str]:
        """The group of every column."""
        return [name for name, V in self.groups.items() for _ in range(V.shape[1])]

    @property
    def gram(self) -> Array:
        """Inner products of the columns. Shape (k, k)."""
        return np.asarray(self.columns.T @ self._scaled(self.columns))
