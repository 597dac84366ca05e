"""Where a legend hides least."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array

_AWAY_PX = 8
_WIDE, _HIGH = 0.6, 0.35
"""Share of a plot that a legend takes."""
_CORNERS = ((-1, -1), (-1, 1), (1, 1), (1, -1))
"""Lower right, upper right, upper left, lower left: the first of those that hide equally much."""


def emptiest_corner(curves: Sequence[tuple[Array, Array]]) -> tuple[int, int]:
    """A legend's offset in pixels, from the right and from below where negative.

    Of curves with the shape (points,) of their x and y.
    """
    x, y = (np.concatenate([c[k] for c in curves] or [np.zeros(0)]) for k in (0, 1))
    good = np.isfinite(x) & np.isfinite(y)
    across, up = _share(x[good]), _share(y[good])

    def hidden(corner: tuple[int, int]) -> int:
        beside = across >= 1 - _WIDE if corner[0] < 0 else across <= _WIDE
        level = up <= _HIGH if corner[1] < 0 else up >= 1 - _HIGH
        return int(np.sum(beside & level))

    side, height = min(_CORNERS, key=hidden)
    return side * _AWAY_PX, height * _AWAY_PX


def _share(values: Array) -> Array:
    """From 0 at the least to 1 at the largest."""
    if not len(values) or values.max() == values.min():
        return np.full(len(values), 0.5)
    return np.asarray((values - values.min()) / (values.max() - values.min()))
