"""How far gain and phase of several files wander over frequency: alike in all of them, and each by itself."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex

SLOW, FINE = 0.7, 0.06
"""In ln f: an octave, and the width of a fixture's well damped resonance."""
_OWN = 1e-6
"""Of the variance, that each point has for itself: what points close together wander by is else singular."""


@dataclass(frozen=True)
class Wandering:
    """Standard deviations of ln of the reading, of each of its parts; by e^{-distance/reach} in ln f."""

    common_slow: float
    common_fine: float
    own_slow: float
    own_fine: float

    def common(self, t: Array, other: Array) -> Array:
        """Covariance of what is alike in all files, between values of ln f. Shape (t, other)."""
        d = np.abs(t[:, None] - other)
        return np.asarray(self.common_slow**2 * np.exp(-d / SLOW) + self.common_fine**2 * np.exp(-d / FINE))

    def covariance(self, t: Array, file: NDArray[np.intp]) -> Array:
        """Of all. Shapes (points,) to (points, points)."""
        own = Wandering(self.own_slow, self.own_fine, 0.0, 0.0).common(t, t)
        return np.asarray(self.common(t, t) + own * (file[:, None] == file))

    def rows(self, t: Array, file: NDArray[np.intp], v: Complex) -> Complex:
        """As changes of the readings `v`, one standard deviation each. Shape (2 points, points)."""
        tiny = _OWN * (self.common_slow**2 + self.common_fine**2 + self.own_slow**2 + self.own_fine**2)
        root = np.linalg.cholesky(self.covariance(t, file) + tiny * np.eye(len(t))).T * v
        return np.concatenate([root, 1j * root])

    @property
    def of_all(self) -> float:
        """Size of what is alike in all files."""
        return float(np.hypot(self.common_slow, self.common_fine))

    @property
    def of_each(self) -> float:
        """Size of what is each file's own."""
        return float(np.hypot(self.own_slow, self.own_fine))
