"""Strips of the core that may come loose: all along x, and some at either long edge."""

import numpy as np
from numpy.typing import NDArray

from drivers.simulated.plant.effects import PartialDebond
from drivers.simulated.plant.specimen import LENGTH_M, WIDTH_M

Array = NDArray[np.float64]

EDGE_STRIPS = 5
"""At each long edge."""
EDGE_STRIP_M = WIDTH_M / 20


def debonded(debond: PartialDebond, strips_x: int) -> Array:
    """Fraction of each strip that is loose. Edge strips in the order of y. A place not kept is refused."""
    if debond.along == "x":
        return _covered(np.linspace(0, LENGTH_M, strips_x + 1), debond.from_m, debond.to_m)
    if debond.along != "y":
        raise ValueError(f'partial_debond along "{debond.along}": "x" or "y"')
    deep = EDGE_STRIPS * EDGE_STRIP_M
    if debond.to_m > deep * (1 + 1e-9) and debond.from_m < (WIDTH_M - deep) * (1 - 1e-9):
        raise ValueError(
            f"partial_debond along y from {1e3 * debond.from_m:.1f} to {1e3 * debond.to_m:.1f} mm "
            f"leaves the edge strips ({1e3 * deep:.1f} mm wide): stay within one of them"
        )
    ends = np.linspace(0, deep, EDGE_STRIPS + 1)
    both = (_covered(e, debond.from_m, debond.to_m) for e in (ends, WIDTH_M - deep + ends))
    return np.concatenate(list(both))


def _covered(ends: Array, low: float, high: float) -> Array:
    inside = np.minimum(ends[1:], high) - np.maximum(ends[:-1], low)
    return np.asarray(np.clip(inside, 0, None) / np.diff(ends))
