"""Values on a grid of Chebyshev points, interpolated by the barycentric formula (Berrut, Trefethen 2004)."""

import numpy as np
from numpy.typing import NDArray

from drivers.simulated.plant.specimen import LENGTH_M, WIDTH_M

Array = NDArray[np.float64]

POINTS_X, POINTS_Y = 21, 15


def points(count: int, length_m: float) -> Array:
    """Chebyshev points of the second kind on [0, length_m], both ends included."""
    return length_m * 0.5 * (1 - np.cos(np.pi * np.arange(count) / (count - 1)))


def weights(x_m: float, count: int, length_m: float) -> Array:
    """What each grid value counts at x. Shape (count,), sum one."""
    distance = x_m - points(count, length_m)
    hit = np.abs(distance) < 1e-12 * length_m
    if hit.any():
        return hit.astype(float)
    w: Array = np.where(np.arange(count) % 2, -1.0, 1.0) / distance
    w[[0, -1]] *= 0.5
    return w / w.sum()


def on_plate(x_m: float, y_m: float) -> Array:
    """Weights of the plate's grid, x slow and y fast. A point off the plate is refused."""
    if not (0 <= x_m <= LENGTH_M and 0 <= y_m <= WIDTH_M):
        raise ValueError(
            f"point ({1e3 * x_m:.1f}, {1e3 * y_m:.1f}) mm is off the plate "
            f"(0 to {1e3 * LENGTH_M} by 0 to {1e3 * WIDTH_M} mm): choose one on it"
        )
    product = np.outer(weights(x_m, POINTS_X, LENGTH_M), weights(y_m, POINTS_Y, WIDTH_M))
    return np.asarray(product.ravel())
