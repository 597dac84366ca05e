"""Frequencies that a sweep left out between its segments, and what would be read there."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex

_STEPS = 20
"""Of a gap, evenly in the logarithm, besides its resonances. With fewer than `fitting.data.noise.FEWEST` its
noise is unknown, and that of the whole sweep with it."""
_WIDE = 1.3
"""Times a frequency, from which the next one measured leaves a gap. A choice."""


def gaps_of(frequency_hz: Array) -> list[tuple[float, float]]:
    """Neighbours with room between them, in Hz. `frequency_hz`: shape (points,)."""
    return [(float(a), float(b)) for a, b in pairwise(np.unique(frequency_hz)) if b > _WIDE * a]


def steps_between(low_hz: float, high_hz: float, poles_hz: Complex) -> Array:
    """Ascending, resonances among them. Shape (steps,), of poles of shape (poles,)."""
    inside = poles_hz.real[(poles_hz.real > low_hz) & (poles_hz.real < high_hz)]
    even = np.geomspace(low_hz, high_hz, _STEPS + 2)[1:-1]
    return np.unique(np.round(np.concatenate([even, inside]), 3))


def nearest(frequency_hz: Array, among_hz: Array) -> NDArray[np.intp]:
    """Places of what is nearest in the logarithm. Shape of `frequency_hz`."""
    return np.asarray(np.argmin(np.abs(np.log(among_hz[None, :] / frequency_hz[:, None])), axis=1))
