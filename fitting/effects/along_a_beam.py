"""What sits at a place of a plate, on a beam. No effect by itself."""

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import Effect
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate


class AlongABeam(Effect):
    """Mixin that makes a beam's effect of a plate's whose last unknown is the place across the plate.

    A beam has no such place: its effect lacks that unknown, and the plate's is called with zero, the axis.
    """

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        change = super().change(plate, np.array([*u, 0.0]))
        assert change is not None
        return change
