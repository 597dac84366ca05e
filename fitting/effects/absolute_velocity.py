"""The laser stands on the floor: it reads the base's motion too, though the data say relative."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import BASE, EVERY_STRUCTURE, Effect
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate


class AbsoluteVelocityEffect(Effect):
    """Velocity plus a / (i omega). It has no size to be fitted."""

    name = "absolute_velocity"
    enters = "observation"
    source = "kinematics of a moving base"
    needs = BASE
    structures = EVERY_STRUCTURE
    discriminating_test = "where the laser's head stands, and whether a reference beam goes to the clamp"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "the data are stated to be absolute" if points.reads == "absolute" else None

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        return np.asarray(v + points.drive_amplitude / (1j * points.omega))

    def story(self, u: Mapping[str, float]) -> str:
        return "the laser reads the base's motion too: the velocities are absolute, not relative to the clamp"
