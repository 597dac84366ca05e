"""What of a beam its matrices are made of: sizes and coefficients of layers, and how its ends are held."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.structures.beam_shapes import NO_ARMS, ORDER, Arms, Shapes, shapes_of
from fitting.structures.beam_width import reach

PARTS = {"K_0": slice(0, 9), "K_1": slice(9, 23), "M": slice(23, 38)}
"""Where coefficients of `beam_shapes.BeamMatrices` are; those of loads follow."""
SLIP = slice(9, 12)
"""Those of the core's shear."""
MASSES = slice(23, 26)
"""Those of all the mass, and of the two faces'."""


@dataclass(frozen=True)
class BeamSection:
    """What of a beam its matrices are made of, one piece of it."""

    ends: str
    length_m: float
    width_m: float
    copies: int
    """Two where it is driven in its centre, both halves moving alike."""
    thickness_m: tuple[float, float, float]
    """Of substrate, core and constraining layer; zero for none."""
    both_sides: bool
    coefficients: tuple[float, ...]
    """Of K_0, K_1 and M, losses left out."""
    rigidity: tuple[float, float]
    """Of substrate and constraining layers in bending, by any common measure."""
    poisson: tuple[float, float, float]
    """Of substrate, core and constraining layer."""
    share: float = 0.0
    """Of the substrate in how far the faces move apart."""
    is_slender: bool = False
    """Whether nothing of its width, nor of its faces' own shear and how they move apart, is counted."""
    order: int = ORDER
    """Of its polynomials."""
    forced_at: tuple[float, ...] = ()
    """Where a force drives it and where it is read then, in shares of its length; empty without a force."""

    @property
    def is_sandwich(self) -> bool:
        """Whether a core shears between two layers."""
        return self.thickness_m[2] > 0

    @property
    def is_doubled(self) -> bool:
        """Whether one is on both sides, so that the middle does not stretch."""
        return self.both_sides and self.is_sandwich

    @property
    def shapes(self) -> Shapes:
        """Its polynomials."""
        return shapes_of(self.ends, self.order)

    @property
    def moves(self) -> NDArray[np.bool_]:
        """Which unknowns it has. Shape (size,)."""
        s = self.shapes
        found = np.ones(s.size, bool)
        if not self.is_sandwich:
            found[s.place["c"]] = False
        if self.is_doubled:
            found[s.place["b"]] = False
        if not self.is_sandwich or self.is_slender:
            for name in ("a", "m", "p_b", "p_c"):
                found[s.place[name]] = False
        return found

    @property
    def of_core(self) -> NDArray[np.bool_]:
        """Which are of how the core stretches across. Shape (size,)."""
        return self.shapes.is_of("a") | self.shapes.is_of("m")

    @property
    def arms(self) -> Arms:
        """Of the faces' own shear in the core's; none where it is not counted, or there is no core."""
        h_b, h_v, h_c = self.thickness_m
        if not self.is_sandwich or self.is_slender:
            return NO_ARMS
        apart = h_v + (h_b + h_c) / 2
        return h_b / 2 / apart, h_c / 2 / apart

    @property
    def faces_poisson(self) -> float:
        """Poisson's ratio of both faces as they bend."""
        return float(np.average(self.poisson[::2], weights=self.rigidity))

    def reach(self, layer: int) -> float:
        """How far from a clamp its hold of a layer's width goes, in shares of the length."""
        L = self.length_m
        return reach(self.width_m / L, self.thickness_m[layer] / L, self.poisson[layer])
