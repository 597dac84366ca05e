"""How campaigns draw numbers."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray


def either_sign(rng: np.random.Generator, low: float, high: float) -> float:
    """A number of either sign whose size lies between two."""
    return float(rng.choice([-1.0, 1.0]) * rng.uniform(low, high))


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """Even in the logarithm."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


_ALONG = {"up": 0.7, "down": 0.15, "random": 0.15}
"""How often points are read in which order: mostly as any program does by itself."""


def two_apart(rng: np.random.Generator, places: Mapping[str, str]) -> tuple[str, str]:
    """Two names whose places, given beside each, differ."""
    while True:
        first, second = (str(name) for name in rng.choice(list(places), 2, replace=False))
        if places[first] != places[second]:
            return first, second


def order_of_segments(rng: np.random.Generator, count: int) -> list[int]:
    """From low to high, from high to low, or any other, each as likely."""
    up = list(range(count))
    return {0: up, 1: up[::-1], 2: list(rng.permutation(count))}[int(rng.integers(3))]


def along(rng: np.random.Generator) -> str:
    """In which order the points of a segment are read: see `order_of_time`."""
    return str(rng.choice(list(_ALONG), p=list(_ALONG.values())))


def order_of_time(rng: np.random.Generator, count: int, along: str) -> NDArray[np.intp]:
    """Indices of points, from low to high, in the order they are read: `up`, `down` or `random`.

    Shape (count,).
    """
    up = np.arange(count, dtype=np.intp)
    if along == "random":
        return rng.permutation(up)
    return up[::-1] if along == "down" else up
