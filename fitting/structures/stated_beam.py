"""What is stated of a beam: its layers, ends, spots, and what follows of that without its theory."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal, Self

import numpy as np

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import Driven, Kind, PlacedMass, PlateSpecimen, Reading
from fitting.stated.layers import Core, Face
from fitting.structures.beam_error import shortened_m

Ends = Literal["clamped-free", "free-free", "clamped-clamped", "centre-driven"]

_HELD_ENDS = {"clamped-free": 1, "free-free": 0, "clamped-clamped": 2, "centre-driven": 1}


@dataclass(frozen=True)
class StatedBeam(Driven[float]):
    """What is stated of it, in SI units; x from a clamped end, or from the centre where that is driven."""

    length_m: float
    """Free length; of both halves together where it is driven in its centre, the mount taken off."""
    width_m: float
    boundary: Ends
    substrate: Face
    constraining: Face | None = None
    core: Core | None = None
    """Without a constraining layer it is a free layer."""
    both_sides: bool = False
    """The same on either side: a free layer, or core and constraining layer."""
    held_width: bool = False
    """Whether it is counted that clamps hold the width (`beam_error`): its held ends are then stiffer."""
    pickup_m: float | None = None
    further_pickups_m: tuple[float, ...] = ()
    """Spots beside the first: rows of data say which one they are of (`at_pickup`)."""
    force_m: float | None = None
    """Where a force drives it, its ends at rest; None: the base does."""
    masses: tuple[PlacedMass, ...] = ()
    """What sits on it, in the middle of its width: a sensor. Of one piece alone."""
    reads: Reading = "relative"
    base_acceleration_m_s2: float = PUBLISHED_G_M_S2
    tolerances: Mapping[str, float] = field(default_factory=dict, hash=False)
    exact: bool = False
    slender: bool = False
    """Whether it is as thin and narrow as handbooks' formulas have it: nothing turns, shears or curves across
    but the core."""
    temperature_c: float | None = None
    """That its faces have; None: the one their moduli are stated for."""

    kind: ClassVar[Kind] = "beam"
    modal_ratios: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if self.force_m is not None:
            # Its ends are at rest: one reading is the other.
            object.__setattr__(self, "reads", "relative")

    @property
    def offers(self) -> frozenset[str]:
        """As `StatedSpecimen` has it; `one piece`: not two halves about a driven centre."""
        found = {"base"} if self.force_m is None else {"force"}
        if self.boundary != "free-free":
            found.add("clamp")
        if self.boundary != "centre-driven":
            found.add("one piece")
        if self.boundary == "clamped-clamped":
            found.add("two clamps")
        if self.constraining is not None:
            found |= {"constraining"} if self.both_sides else {"constraining", "whole"}
        return frozenset(found)

    @property
    def places(self) -> Mapping[str, float]:
        """Where it is read, and where a force drives it, in m: stated numbers too."""
        stated = {"pickup": self.pickup_m, "force": self.force_m}
        return {name: x for name, x in stated.items() if x is not None}

    def at_temperature(self, temperature_c: float) -> Self:
        """The same beam warmer or colder; an exact one that states nothing of its metal is as stated."""
        faces = (self.substrate, self.constraining)
        if self.exact and all(f is None or f.young_per_k is None for f in faces):
            return self
        return replace(self, temperature_c=temperature_c)

    @property
    def span_m(self) -> float:
        """What vibrates as one piece: half of it where the centre is driven."""
        return self.length_m / 2 if self.boundary == "centre-driven" else self.length_m

    @property
    def is_doubled(self) -> bool:
        """Whether a constrained layer is on both sides."""
        return self.both_sides and self.constraining is not None

    @property
    def states_loss(self) -> bool:
        """Whether it is known what its metal loses: a core's loss is what is left beside that."""
        faces = (self.substrate, self.constraining)
        return self.exact or any(f is not None and f.loss_is_stated for f in faces)

    @property
    def parts_faces(self) -> bool:
        """Whether a core lets two faces move apart."""
        return self.core is not None and self.constraining is not None and not self.slender

    @property
    def share(self) -> float:
        """Of the substrate in how far faces move apart: w is then where the mass is."""
        b, v, c = self.substrate, self.core, self.constraining
        if v is None or c is None:
            return 0.0
        m_b, m_v, m_c = (x.density_kg_m3 * x.thickness_m for x in (b, v, c))
        twice = 2 if self.is_doubled else 1
        return twice * (m_c + m_v / 2) / (m_b + twice * (m_c + m_v))

    @property
    def copies(self) -> int:
        """How many pieces move alike."""
        return 2 if self.boundary == "centre-driven" else 1

    @property
    def held_width_m(self) -> float:
        """What makes it stiffer at all held ends, as a shorter span."""
        return self.held_ends * shortened_m(self.width_m, self.poisson)

    @property
    def held_ends(self) -> int:
        """How many ends of one piece a clamp holds."""
        return _HELD_ENDS[self.boundary]

    @property
    def poisson(self) -> float:
        """Of the faces, weighed by their stiffness."""
        faces = [f for f in (self.substrate, self.constraining) if f is not None]
        stiff = np.array([f.young_pa * f.thickness_m for f in faces])
        return float(stiff @ [f.poisson for f in faces] / stiff.sum())

    @property
    def as_plate(self) -> PlateSpecimen | None:
        """A plate of the same layers: what a wave in them sees. None where no core shears between faces."""
        if self.core is None or self.constraining is None:
            return None
        sides = (self.length_m, self.width_m)
        both = self.both_sides
        return PlateSpecimen(*sides, "free", self.substrate, self.constraining, self.core, both_sides=both)
