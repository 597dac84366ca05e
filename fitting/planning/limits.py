"""What keeps a band from being known better though everything is measured: each stated number's part."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array
from fitting.nuisances.nuisance import Nuisance
from fitting.planning.aims import Aims
from fitting.planning.sensitivity import Sensitivity

_WORTH_SAYING = 0.97
"""Of the error left: a number that takes away less than 3 % of it when exact is not named."""


def limited_by(s: Sensitivity, aims: Aims, taken: Array, each: Sequence[Nuisance]) -> list[tuple[str, float]]:
    """Stated numbers, each with the worst relative error left if it were exact, best first.

    `taken`: shape (candidates,).
    """
    C = s.covariance(taken)
    now, found = float(aims.errors(C).max()), []
    for k, nuisance in enumerate(each):
        at = s.of_law + k
        # One number known exactly: its row and column leave the covariance.
        known = C - np.outer(C[:, at], C[at]) / C[at, at]
        left = float(aims.errors(known).max())
        if left < _WORTH_SAYING * now:
            found.append((nuisance.name, left))
    return sorted(found, key=lambda f: f[1])
