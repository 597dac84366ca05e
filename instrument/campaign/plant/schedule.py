"""Which points a sweep of the published plate has, and when each is read."""

import numpy as np

from fitting.arrays import Array, Integers
from instrument.campaign.draws import order_of_time
from instrument.campaign.schedule import Schedule

_BOUNDS_HZ = (((14.0, 14.0), (25.0, 26.0)), ((85.0, 90.0), (112.0, 115.0)), ((250.0, 258.0), (300.0, 310.0)))
"""Of the three resonance regions: lowest and highest beginning, lowest and highest end."""
_POINTS = (60, 121)
_SECONDS_A_POINT = (2.743, 1.6, 1.6)
_LATE_S = 0.05
"""Mean of what a point takes beyond that, exponentially distributed."""
_BETWEEN_S = (40.0, 160.0)


def draw_schedule(rng: np.random.Generator, levels_g: tuple[float, ...]) -> Schedule:
    """Three dense segments; levels from low to high, the segments of each in the same order."""
    segments = [_grid(rng, *bounds) for bounds in _BOUNDS_HZ]
    order = {0: [0, 1, 2], 1: [2, 1, 0], 2: list(rng.permutation(3))}[int(rng.integers(3))]
    along = str(rng.choice(["up", "down", "random"], p=[0.7, 0.15, 0.15]))
    parts: list[tuple[Array, Integers, Integers, Array, Array]] = []
    now = 0.0
    for level in levels_g:
        for k in order:
            f = segments[k]
            when = now + np.cumsum(_SECONDS_A_POINT[k] + rng.exponential(_LATE_S, len(f)))
            now = float(when[-1]) + float(rng.uniform(*_BETWEEN_S))
            time = np.empty(len(f))
            time[order_of_time(rng, len(f), along)] = when
            number = len(parts) + 1
            parts.append(
                (
                    f,
                    np.full(len(f), k + 1, dtype=np.intp),
                    np.full(len(f), number, dtype=np.intp),
                    np.full(len(f), level),
                    np.round(time, 3),
                )
            )
    return Schedule(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _grid(rng: np.random.Generator, begin: tuple[float, float], end: tuple[float, float]) -> Array:
    count = int(rng.integers(*_POINTS))
    return np.round(np.linspace(rng.uniform(*begin), rng.uniform(*end), count), 3)
