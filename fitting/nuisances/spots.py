"""Where a structure is read, and where a force drives it: rows and loads there, by its stated numbers."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from fitting.arrays import Array
from fitting.nuisances.placed import Placed, PlacedPoints
from fitting.widened.enriched_plate import EnrichedReducedPlate

Spot = Literal["pickup", "force"]
SPOTS: tuple[Spot, ...] = get_args(Spot)
Place = tuple[float, float]
"""X and y, in m."""


@dataclass(frozen=True)
class StatedSpots:
    """The spots that a specimen has. `z` has shape (numbers,) throughout, in standard deviations."""

    points: PlacedPoints
    stated: Mapping[Spot, Place]
    meshed: Mapping[Spot, Place]
    """Those of the specimen that the reduced plate was built for."""

    def row(self, plate: EnrichedReducedPlate, z: Array) -> Array:
        """Reads w at the pickup, where it is on the plate as long and as wide as it is. Shape (k,)."""
        (x, _), (y, _) = self._at("pickup", z)
        return plate.row(x, y)

    def row_change(self, plate: EnrichedReducedPlate, z: Array) -> Array:
        """Of what reads at the pickup. Shape (k,)."""
        return (
            self.row(plate, z) - plate.pickup_row if "pickup" in self.stated else np.zeros(len(plate.observe))
        )

    def force_change(self, plate: EnrichedReducedPlate, z: Array) -> Array | float:
        """Additional load of a force. Shape (k,)."""
        if "force" not in self.stated:
            return 0.0
        (x, _), (y, _) = self._at("force", z)
        return plate.row(x, y) - plate.row(*self.meshed["force"])

    def rows_by(self, spot: Spot, plate: EnrichedReducedPlate, z: Array) -> dict[int, Array]:
        """Derivatives of the row at a spot to the numbers that move it, by their places. Shape (k,) each."""
        if spot not in self.stated:
            return {}
        (x, by_x), (y, by_y) = self._at(spot, z)
        found: dict[int, Array] = {}
        for slopes, (dx, dy) in ((by_x, (1, 0)), (by_y, (0, 1))):
            if slopes:
                slope = plate.row(x, y, dx, dy)
                found |= {k: size * slope for k, size in slopes.items()}
        return found

    def _at(self, spot: Spot, z: Array) -> Placed:
        """X and y in m of the point on the plate as it was meshed, and how they go with z."""
        return self.points.at(self.stated[spot], spot, z)
