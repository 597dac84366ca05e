"""Where a laser's spot was from temperature to temperature, if a fit leaves it open."""

from itertools import combinations

import numpy as np

from fitting.arrays import Array
from fitting.temperature.members import Joined

_SPOT = "pickup"
"""Kind of the stated numbers that say where it is."""


def spots_moved(joined: Joined, z: Array) -> Array:
    """How far each spot's coordinates are from where they are stated, in standard deviations.

    `z` are the stated numbers, shape (numbers,). Shape (coordinates of all spots,).
    """
    return np.array([at for n, at in zip(joined.each, z, strict=True) if n.kind == _SPOT])


def spots_apart_m(joined: Joined, z: Array) -> float:
    """The largest distance between the spots of two members, whose places are stated alike.

    `z` are the stated numbers, shape (numbers,).
    """
    each = [
        np.array([joined.each[j].sigma * z[j] for j in at if joined.each[j].kind == _SPOT])
        for at in joined.places
    ]
    return max((float(np.linalg.norm(a - b)) for a, b in combinations(each, 2)), default=0.0)
