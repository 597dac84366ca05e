"""A layered beam as a 3D solid: bricks of third order along it, of second across and through each layer.

Half its width, the plane in its middle a plane of symmetry: a base in heave and pitch stirs nothing else. It
shares nothing with the beam that is fitted.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from drivers.arrays import Array
from drivers.simulated.plant.layered_solid import LayeredSolid, Sheet
from drivers.simulated.plant.lines import Line

Ends = Literal["clamped-free", "clamped-clamped", "centre-driven"]

PIECES = 20
"""Along the beam, besides the fine ones at a clamp."""
_NEAR_ROOT = (0.4, 1.5)
"""Of the stack's height: where fine pieces end."""


@dataclass(frozen=True)
class BeamStated:
    """What the beam is."""

    length_m: float
    """Free length; of both halves where it is driven in its centre."""
    width_m: float
    ends: Ends
    sheets: tuple[Sheet, ...]
    """From below."""
    cores: tuple[int, ...]
    """Which of them are viscoelastic."""
    spot_x_m: float
    """From a clamped end, or from the centre."""

    @property
    def span_m(self) -> float:
        """What vibrates as one piece."""
        return self.length_m / 2 if self.ends == "centre-driven" else self.length_m


class SolidBeam(LayeredSolid):
    """The unreduced model."""

    def __init__(self, stated: BeamStated, pieces: int = PIECES) -> None:
        self.stated = stated
        height = sum(s.thickness_m for s in stated.sheets)
        L, near = stated.span_m, np.array(_NEAR_ROOT) * height
        ends = np.concatenate([np.linspace(0, L, pieces + 1), near[near < L / pieces]])
        if stated.ends == "clamped-clamped":
            ends = np.concatenate([ends, L - near[near < L / pieces]])
        half = stated.width_m / 2
        x, y = Line(tuple(np.unique(ends).tolist()), 3), Line((0.0, half / 2, half), 2)
        # Both halves of the width, and of a beam that is driven in its centre.
        super().__init__(stated.sheets, x, y, times=4.0 if stated.ends == "centre-driven" else 2.0)

    def deflection(self, x_m: float) -> Array:
        """Row that reads w on the middle of the upper face. Shape (size,)."""
        return self.row(x_m, 0.0)

    @cached_property
    def free(self) -> NDArray[np.intp]:
        """Degrees of freedom that move. Shape (n,)."""
        nx, ny, nz = self.shape
        held = np.zeros((nx, ny, nz, 3), bool)
        held[0] = True
        if self.stated.ends == "clamped-clamped":
            held[-1] = True
        held[:, 0, :, 1] = True
        return np.flatnonzero(~held.ravel())
