"""Which points a sweep of the published plate has, and when each is read."""

import numpy as np

from campaign.draws import along, order_of_segments, order_of_time
from campaign.schedule import LATE_S, Pass, Schedule, between_s
from fitting.arrays import Array

_BOUNDS_HZ = (((14.0, 14.0), (25.0, 26.0)), ((85.0, 90.0), (112.0, 115.0)), ((250.0, 258.0), (300.0, 310.0)))
"""Of the three resonance regions: lowest and highest beginning, lowest and highest end."""
_POINTS = (60, 121)
_SECONDS_A_POINT = (2.743, 1.6, 1.6)


def draw_schedule(rng: np.random.Generator, levels_g: tuple[float, ...]) -> Schedule:
    """Three dense segments; levels from low to high, the segments of each in the same order."""
    segments = [_grid(rng, *bounds) for bounds in _BOUNDS_HZ]
    order, up_or_down = order_of_segments(rng, len(segments)), along(rng)
    passes: list[Pass] = []
    now = 0.0
    for level in levels_g:
        for k in order:
            f = segments[k]
            when = now + np.cumsum(_SECONDS_A_POINT[k] + rng.exponential(LATE_S, len(f)))
            now = float(when[-1]) + between_s(rng)
            time = np.empty(len(f))
            time[order_of_time(rng, len(f), up_or_down)] = when
            passes.append(Pass(k + 1, f, level, time))
    return Schedule.of_passes(passes)


def _grid(rng: np.random.Generator, begin: tuple[float, float], end: tuple[float, float]) -> Array:
    count = int(rng.integers(*_POINTS))
    return np.round(np.linspace(rng.uniform(*begin), rng.uniform(*end), count), 3)
