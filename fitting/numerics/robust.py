"""A scatter that a few wild values do not move."""

import numpy as np

from fitting.arrays import Array

_MAD_TO_STD = 1.4826
"""Median absolute deviation to standard deviation, of a normal distribution."""


def robust_scatter(values: Array) -> float:
    """Standard deviation of values that are mostly noise, by their median. Shape (values,)."""
    return float(_MAD_TO_STD * np.median(np.abs(values - np.median(values))))
