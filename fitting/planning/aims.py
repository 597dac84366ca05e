"""What is to be known, as directions among the unknowns: ln G' and ln eta over a band."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.laws import CoreLaw

_COUNT = 21
"""Frequencies of a band, over which the worst is looked for: laws are smoother than that."""


@dataclass(frozen=True)
class Aims:
    """G' and eta at frequencies of a band."""

    frequency_hz: Array
    """Shape (frequencies,)."""
    gradient: Array
    """Of ln G' and of ln eta to the law's log parameters. Shape (2, frequencies, parameters)."""

    @classmethod
    def over(cls, law: CoreLaw, low_hz: float, high_hz: float, count: int = _COUNT) -> "Aims":
        """Evenly in the logarithm, both ends in it."""
        f = np.geomspace(low_hz, high_hz, count)
        dG = law.jacobian(2 * np.pi * f) * law.values[:, None]
        G, eta = law.storage_and_loss(2 * np.pi * f)
        by_ln_G = dG.real / G
        by_ln_eta = dG.imag / (G * eta) - by_ln_G
        return cls(f, np.array([by_ln_G.T, by_ln_eta.T]))

    def errors(self, covariance: Array) -> Array:
        """Relative standard errors of G' and of eta. Shape (2, frequencies)."""
        n = self.gradient.shape[2]
        square = np.einsum("qfi,ij,qfj->qf", self.gradient, covariance[:n, :n], self.gradient)
        return np.sqrt(np.maximum(square, 0.0))
