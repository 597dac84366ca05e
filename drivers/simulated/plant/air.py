"""Added mass of still incompressible air on both faces of an unbaffled plate, by a lattice of vortex rings.

A jump of potential, constant on a panel, is a vortex ring around it; its velocity normal to the plate is a
sum over the panel's corners. The pressure jump is density times the rate of the potential jump.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def centres(length_m: float, width_m: float, shape: tuple[int, int]) -> tuple[Array, Array]:
    """Panel centres along x and along y. A quarter of a panel is left free at every edge: no jump there."""
    return _lattice(length_m, shape[0])[0], _lattice(width_m, shape[1])[0]


def _lattice(length_m: float, count: int) -> tuple[Array, float]:
    size = length_m / (count + 0.5)
    return np.asarray(size * (0.75 + np.arange(count))), size


def mass_per_density(length_m: float, width_m: float, shape: tuple[int, int]) -> Array:
    """Force on each panel per its normal acceleration and unit density (m^3). Shape (panels, panels)."""
    x, dx = _lattice(length_m, shape[0])
    y, dy = _lattice(width_m, shape[1])
    X, Y = (a.ravel() for a in np.meshgrid(x, y, indexing="ij"))
    u, v = X[:, None] - X, Y[:, None] - Y

    def corner(a: Array, b: Array) -> Array:
        return np.hypot(a, b) / (a * b)

    a, b, c, d = u + dx / 2, u - dx / 2, v + dy / 2, v - dy / 2
    normal_velocity = -(corner(a, c) - corner(a, d) - corner(b, c) + corner(b, d)) / (4 * np.pi)
    mass = dx * dy * np.linalg.inv(normal_velocity)
    return np.asarray(-0.5 * (mass + mass.T))
