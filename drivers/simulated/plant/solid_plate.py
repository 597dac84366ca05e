"""A cantilever plate of any size as a 3D solid: bricks of fourth order along both sides, of second through.

It shares nothing with the plate that is fitted. The clamp holds the whole root, treatment and all.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from drivers.arrays import Array
from drivers.simulated.plant.effects import PartialDebond
from drivers.simulated.plant.layered_solid import LayeredSolid, Sheet
from drivers.simulated.plant.lines import Line

PIECES = (6, 4)
"""Along x and y, besides the fine one at the clamp."""
_ORDER = 4
_NEAR_ROOT = 2.0
"""Of the stack's height: where the fine piece ends."""
_SLIVER = 0.1
"""Of a strip's width: a piece's end so near to its own gives way to it."""


@dataclass(frozen=True)
class PlateStated:
    """What the plate is; x from the clamp, y from a long edge."""

    length_m: float
    width_m: float
    sheets: tuple[Sheet, ...]
    """From below: the substrate, and of a treated plate the core and the constraining layer."""

    def refuse_off(self, x_m: float, y_m: float) -> None:
        """Raise `ValueError` for a place that is not on it."""
        if not (0 <= x_m <= self.length_m and 0 <= y_m <= self.width_m):
            raise ValueError(
                f"point ({1e3 * x_m:.1f}, {1e3 * y_m:.1f}) mm is off the plate "
                f"(0 to {1e3 * self.length_m:g} by 0 to {1e3 * self.width_m:g} mm): choose one on it"
            )


class SolidPlate(LayeredSolid):
    """A plate as a solid with all its degrees of freedom, before it is reduced."""

    def __init__(
        self, stated: PlateStated, pieces: tuple[int, int] = PIECES, loose: PartialDebond | None = None
    ) -> None:
        """`loose`: pieces end where it does."""
        near = _NEAR_ROOT * sum(s.thickness_m for s in stated.sheets)
        ends = np.linspace(0, stated.length_m, pieces[0] + 1)
        if near < ends[1]:
            ends = np.insert(ends, 1, near)
        across = np.linspace(0, stated.width_m, pieces[1] + 1)
        if loose is not None:
            strip = [loose.from_m, loose.to_m]
            ends, across = (
                _with_ends(e, strip) if axis == loose.along else e for axis, e in (("x", ends), ("y", across))
            )
        x, y = (Line(tuple(e.tolist()), _ORDER) for e in (ends, across))
        super().__init__(stated.sheets, x, y)

    @cached_property
    def free(self) -> NDArray[np.intp]:
        """Degrees of freedom that move. Shape (n,)."""
        held = np.zeros((*self.shape, 3), bool)
        held[0] = True
        return np.flatnonzero(~held.ravel())

    @cached_property
    def top(self) -> NDArray[np.intp]:
        """W of the nodes of the upper face, x slow. Shape (nodes x times nodes y,)."""
        nx, ny, nz = self.shape
        node = np.arange(nx * ny * nz).reshape(nx, ny, nz)[:, :, -1]
        return np.asarray(3 * node.ravel() + 2)


def _with_ends(ends: Array, strip: list[float]) -> Array:
    """Pieces that end where a strip does, and none so thin that it upsets the solid. Shape (pieces + 1,)."""
    low, high = np.clip(strip, ends[0], ends[-1])
    sliver = _SLIVER * (high - low)
    inner = ends[1:-1]
    kept = inner[np.abs(inner[:, None] - [low, high]).min(axis=1) > sliver]
    return np.unique([ends[0], *kept, low, high, ends[-1]])
