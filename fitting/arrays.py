"""Types of arrays, of places in them, and of places on a plate."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]
"""Which of some points, true or false."""
Integers = NDArray[np.intp]
"""Numbers: of segments, sweeps, spots."""
Indices = NDArray[np.intp]
"""Places in another array."""
Places = Indices | slice
Place = tuple[float, float]
"""A place on a plate: x and y in m."""


def as_slice(places: Indices) -> Places:
    """Indices as a slice, which copies nothing, where they follow one another. Shape (any,)."""
    together = len(places) and np.all(np.diff(places) == 1)
    return slice(int(places[0]), int(places[-1]) + 1) if together else places
