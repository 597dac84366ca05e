"""Whether stated numbers, each moved within its tolerance, are moved together further than they may be.

What a fit makes of them, in their tolerances z, has the covariance I - C before there are data: the prior's,
of which the posterior's C is left (law of total covariance). Along a direction that the data hardly inform z
stays near 0, and a pull of 1 there is many standard deviations.
"""

import numpy as np

from fitting.arrays import Array
from fitting.numerics.chances import chi2_above

INFORMED = 0.05
"""Part of the prior's variance that data have to take away for a direction to count: below, rounding and the
curvature of the fit are as large."""
UNLIKELY = 1e-4
"""Probability below which a remark is due: that of a check of the diagnosis. A choice; clean sweeps of solid
plates have 0.04 and more."""


def pulled_together(z: Array, C: Array) -> tuple[float, int]:
    """Chi-square of what was moved, and of how many directions. `z` of shape (count,), `C` (count, count)."""
    informed, U = np.linalg.eigh(np.eye(len(z)) - C)
    counted = informed > INFORMED
    along = (U.T @ z)[counted]
    return float(np.sum(along**2 / informed[counted])), int(np.sum(counted))


def is_unlikely(chi_square: float, directions: int) -> bool:
    """Whether numbers stated rightly are hardly ever moved so."""
    return directions > 0 and bool(chi2_above(chi_square, directions) < UNLIKELY)
