"""Residuals in units of what noise and the plate model's own error explain.

The covariance is sigma^2 + sum of b b^T: white noise with a small share of the reading, and for every
segment a common shift of its resonances, of its gain and of its phase. What a layer-wise plate gets wrong
against a 3D solid is of that kind; taken as white it would hide effects, left out be taken for one.
"""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array

SHARE = 1e-3
"""White part of the model's error, of the reading."""


@dataclass(frozen=True)
class Whitening:
    """(1 + B B^T)^-1/2 for residuals already over sigma."""

    U: Array
    """Orthonormal directions of the model's error. Shape (data, nuisances)."""
    shrink: Array
    """What is taken off along each. Shape (nuisances,)."""

    @classmethod
    def of(cls, B: Array) -> "Whitening":
        """`B` has one column a nuisance of one standard deviation. Shape (data, nuisances)."""
        U, s, _ = np.linalg.svd(B, full_matrices=False)
        return cls(U, 1 - 1 / np.sqrt(1 + s**2))

    def along(self, whitened: Array) -> Array:
        """Parts of whitened residuals along the model's error. Shape (nuisances that have a size,)."""
        return np.asarray((self.U.T @ whitened)[self.shrink > 0])

    def __call__(self, r: Array) -> Array:
        """Shape (data,) or (data, any), as given."""
        along = self.U.T @ r
        return np.asarray(r - self.U @ (self.shrink * along.T).T)
