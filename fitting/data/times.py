"""Whether the times of a sweep's points say when each was measured."""

import numpy as np

from fitting.arrays import Array
from fitting.sweep import Sweep

_LEAST_CYCLES = 1.0
"""Of the median frequency, a point: a reading takes several. Hours written as seconds are below."""
_LONGEST_S = 1800.0
"""A point, on the average: milliseconds written as seconds are beyond. A choice."""


def are_seconds(time_s: Array, frequency_hz: Array) -> bool:
    """Whether times differ, and by no less and no more than readings can take. Shape (points,) each."""
    moments, duration = len(np.unique(time_s)), float(np.ptp(time_s))
    if len(time_s) < 2:
        return True
    cycles = duration * float(np.median(frequency_hz))
    return moments > 1 and cycles >= _LEAST_CYCLES * (moments - 1) and duration <= _LONGEST_S * len(time_s)


def is_timed(sweep: Sweep) -> bool:
    """Whether a sweep has such times."""
    return sweep.time_s is not None and are_seconds(sweep.time_s, sweep.frequency_hz)
