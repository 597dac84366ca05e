"""How campaigns draw numbers."""

import numpy as np
from numpy.typing import NDArray


def either_sign(rng: np.random.Generator, low: float, high: float) -> float:
    """Of a size between."""
    return float(rng.choice([-1.0, 1.0]) * rng.uniform(low, high))


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """Even in the logarithm."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def order_of_time(rng: np.random.Generator, count: int, along: str) -> NDArray[np.intp]:
    """Indices of points, from low to high, in the order they are read: `up`, `down` or `random`.

    Shape (count,).
    """
    up = np.arange(count, dtype=np.intp)
    if along == "random":
        return rng.permutation(up)
    return up[::-1] if along == "down" else up
