"""Levels of a sweep: which of its points were driven alike.

A commanded level is the same from point to point, an achieved one scatters by a controller's few percent, and
one that follows the frequency never comes back: none of these is a level for each point.
"""

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array

_APART = 1.05
"""Ratio of neighbours among all amplitudes, from which they are of two levels: beyond what a controller
leaves. A choice."""
_FEWEST = 3
"""Points of a level, in the median: with fewer the amplitude goes up or down, and there are no levels."""
_TELLING = 1.1
"""Ratio of two levels from which they are counted as two: less tells nothing of strain. A choice."""


def by_level(amplitude: Array) -> list[NDArray[np.intp]]:
    """Which points are of each level, from the lowest on; all of them where there are none to tell apart.

    `amplitude` of the drive, positive, shape (points,).
    """
    order = np.argsort(amplitude, kind="stable")
    steps = amplitude[order][1:] > _APART * amplitude[order][:-1]
    parts = np.split(order, np.flatnonzero(steps) + 1)
    if np.median([len(p) for p in parts]) < _FEWEST:
        return [np.arange(len(amplitude))]
    return [np.sort(p) for p in parts]


def are_of(level: float, amplitude: Array) -> NDArray[np.bool_]:
    """Which points are of a level, whose middle is given. Shape (points,)."""
    return np.asarray(np.maximum(amplitude / level, level / amplitude) <= _APART)


def count_of_levels(amplitude: Array) -> int:
    """How many there are that lie a tenth apart and more. Shape (points,)."""
    count, last = 0, 0.0
    for a in np.unique(amplitude):
        if a > _TELLING * last:
            count, last = count + 1, a
    return count


def to_one_level(amplitude: Array) -> Array:
    """Factor that takes each reading to the level of the middle one; exactly one where all are alike.

    Shape (points,).
    """
    return np.asarray(np.median(amplitude) / amplitude)
