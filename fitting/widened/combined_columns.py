"""Combinations of a plate's columns: all of them together, or its own alone and the rest as they are."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray

from fitting.arrays import Array

_OVERLAP = 1e-6
"""Columns of two groups closer than this are one."""
_APART = 0.01
"""Columns at least as far from one another are left as they are."""


@dataclass(frozen=True)
class AllCombined:
    """Combinations of all columns."""

    T: Array
    """Shape (columns, fewer)."""

    def along(self, rows: Any) -> Any:
        """Transform the last axis (columns)."""
        return rows @ self.T

    def square(self, A: Any) -> Any:
        """Transform the last two axes (matrices)."""
        return self.T.T @ A @ self.T


@dataclass(frozen=True)
class OwnCombined:
    """Combinations of some columns, then the rest as they are: most columns are of spans."""

    V: Array
    """Shape (own, fewer)."""
    own: slice | NDArray[np.intp]
    rest: slice | NDArray[np.intp]

    def along(self, rows: Any) -> Any:
        """Transform the last axis (columns)."""
        return np.concatenate([rows[..., self.own] @ self.V, rows[..., self.rest]], axis=-1)

    def square(self, A: Any) -> Any:
        """Transform the last two axes (matrices)."""
        half = self.along(A)
        return np.concatenate([self.V.T @ half[..., self.own, :], half[..., self.rest, :]], axis=-2)


def own_and_beside(gram: Array, is_own: NDArray[np.bool_]) -> Array | None:
    """The combinations that leave some columns first, and have what the others add to them orthonormal.

    Shapes (k, k) and (k,) to (k, fewer); None where all columns are well apart.
    """
    if la.eigvalsh(gram)[0] > _APART:
        return None
    own, rest = np.flatnonzero(is_own), np.flatnonzero(~is_own)
    shared = -np.linalg.solve(gram[np.ix_(own, own)], gram[np.ix_(own, rest)])
    values, vectors = la.eigh(gram[np.ix_(rest, rest)] + gram[np.ix_(rest, own)] @ shared)
    kept = values > _OVERLAP
    beside = vectors[:, kept] / np.sqrt(values[kept])
    T = np.zeros((len(is_own), len(own) + beside.shape[1]))
    T[own, np.arange(len(own))] = 1.0
    T[own, len(own) :], T[rest, len(own) :] = shared @ beside, beside
    return T
