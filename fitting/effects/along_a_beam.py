"""What sits at a place of a plate, on a beam. No effect by itself."""

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import Effect
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate


class AlongABeam(Effect):
    """A beam knows no place across it: put before a plate's effect, whose last unknown is that one.

    It is nought, on the beam's axis; the form on a beam lacks it.
    """

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        change = super().change(plate, np.array([*u, 0.0]))
        assert change is not None
        return change
