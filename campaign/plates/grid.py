"""A tensor grid of quadratic bricks: where its lines are, and shape functions along one axis."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from campaign.plates.geometry import TruePlate
from fitting.arrays import Array

_NEAREST_M = 2e-4
"""Lines of the regular grid closer than this to a wanted one give way to it."""


@dataclass(frozen=True)
class Fineness:
    """How many columns of bricks, and the lines that resolve the clamp and the edges."""

    along_x: int = 14
    along_y: int = 8
    near_root: tuple[float, ...] = (0.15, 0.6, 2.0)
    """Distance from the clamp in plate thicknesses."""
    near_edge: tuple[float, ...] = (0.3, 1.2)
    """Distance from the long edges in plate thicknesses."""
    near_tip: tuple[float, ...] = ()
    """Distance from the far end in plate thicknesses: a free end carries no twist either."""


@dataclass(frozen=True)
class BrickGrid:
    """Ends of the bricks along each axis, in m."""

    x: Array
    y: Array
    z: Array

    @property
    def nodes(self) -> tuple[Array, Array, Array]:
        """Ends and middles along each axis. Shape (n,) each."""
        return fine(self.x), fine(self.y), fine(self.z)

    @property
    def middles(self) -> tuple[Array, Array]:
        """Of the bricks, along x and along y. Shape (n,) each."""
        return (self.x[1:] + self.x[:-1]) / 2, (self.y[1:] + self.y[:-1]) / 2


def grid_of(plate: TruePlate, fineness: Fineness, lines_x: Array, lines_y: Array) -> BrickGrid:
    """The grid of a plate, with lines at the places (m) that its effects ask for. Shape (n,) each."""
    thick = float(sum(plate.heights_m))
    edge = np.array(fineness.near_edge) * thick
    ends = np.concatenate(
        [np.array(fineness.near_root) * thick, plate.length_m - np.array(fineness.near_tip) * thick]
    )
    x = _lines(plate.length_m, fineness.along_x, ends, lines_x)
    y = _lines(plate.width_m, fineness.along_y, np.concatenate([edge, plate.width_m - edge]), lines_y)
    return BrickGrid(x, y, np.cumsum([0.0, *plate.heights_m]))


def _lines(length: float, count: int, near: Array, wanted: Array) -> Array:
    """Ends of the bricks: even, refined, and with the wanted ones in place of too near others."""
    even = np.linspace(0, length, count + 1)
    spread = length / count
    # A refining line next to an even one makes a sliver: the even one gives way.
    free = [a for a in even[1:-1] if not near.size or np.abs(a - near).min() > 0.3 * spread]
    lines = np.unique([0.0, length, *free, *near])
    inside = np.unique(wanted[(wanted > _NEAREST_M) & (wanted < length - _NEAREST_M)])
    ends = (lines == 0) | (lines == length)
    if inside.size:
        clear = np.abs(lines[:, None] - inside).min(axis=1) > max(_NEAREST_M, 0.05 * spread)
        lines = lines[ends | clear]
    return np.unique([*lines, *inside])


def fine(ends: Array) -> Array:
    """Nodes along one axis: ends and middles. Shapes (n,) to (2 n - 1,)."""
    return np.sort(np.concatenate([ends, (ends[1:] + ends[:-1]) / 2]))


def interpolation(ends: Array, at: float) -> Array:
    """Quadratic shape functions of all nodes along one axis, at one place."""
    e = min(max(int(np.searchsorted(ends, at, side="right")) - 1, 0), len(ends) - 2)
    s = (at - ends[e]) / (ends[e + 1] - ends[e])
    row = np.zeros(2 * len(ends) - 1)
    row[2 * e : 2 * e + 3] = (1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)
    return row


def line_mass(ends: Array, weight: Array | None = None) -> Array:
    """Mass matrix of the shape functions along one axis, weighted brick by brick."""
    local = np.array([[4, 2, -1], [2, 16, 2], [-1, 2, 4]]) / 30
    sizes = np.diff(ends) * (1.0 if weight is None else weight)
    out = np.zeros((2 * len(ends) - 1,) * 2)
    for e, h in enumerate(sizes):
        out[2 * e : 2 * e + 3, 2 * e : 2 * e + 3] += h * local
    return out


def dissected(count_x: int, count_y: int) -> NDArray[np.intp]:
    """Columns of nodes (i, j) in nested dissection, for factors with few entries. Shape (columns, 2)."""
    return np.array(_dissect(0, count_x, 0, count_y))


def _dissect(x0: int, x1: int, y0: int, y1: int) -> list[tuple[int, int]]:
    """Both halves, then the line of brick ends that parts them."""
    wide = x1 - x0 >= y1 - y0
    low, high = (x0, x1) if wide else (y0, y1)
    cut = (low + high) // 2
    cut += cut % 2
    if high - low <= 4 or not low < cut < high - 1:
        return [(i, j) for i in range(x0, x1) for j in range(y0, y1)]
    if wide:
        return _dissect(x0, cut, y0, y1) + _dissect(cut + 1, x1, y0, y1) + [(cut, j) for j in range(y0, y1)]
    return _dissect(x0, x1, y0, cut) + _dissect(x0, x1, cut + 1, y1) + [(i, cut) for i in range(x0, x1)]
