"""Readings that take no part in a fit, and why: for each the name of the effect that spoils it."""

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Mask

Reasons = NDArray[np.object_]
"""Of every reading a word; empty where it takes part. Shape (points,)."""
LOST = "signal_dropout"
"""Off the curve of its neighbours by far (`fitting.data.strays`)."""
DISTURBED = "fixture_resonance"
"""In a stretch that no law follows (`fitting.diagnosis.problem.glitch`)."""
INSENSITIVE = "insensitive"
"""Of a file with a misfit: the reading depends so little on the core that it speaks of the rig alone."""


def reasons(aside: Mask, why: str) -> Reasons:
    """One reason for those set aside, none for the others. Shape (points,)."""
    return np.where(aside, why, "").astype(object)
