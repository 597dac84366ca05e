"""The base is not driven at the level that was commanded."""

from collections.abc import Mapping

import numpy as np

from fitting.data.level import level_error
from fitting.data.noise import Noise
from fitting.effects.base import BASE, EVERY_STRUCTURE, ChannelFinding, Effect
from fitting.effects.given import Points
from fitting.sweep import Sweep
from fitting.widened.enriched_plate import EnrichedReducedPlate


class LevelErrorEffect(Effect):
    """Seen in the reference channel; velocity over acceleration does not feel it."""

    name = "level_error"
    enters = "level"
    source = "reference channel over command"
    needs = BASE
    structures = EVERY_STRUCTURE
    discriminating_test = "a second accelerometer on the base"

    def seen(self, sweep: Sweep, noise: Noise) -> ChannelFinding | None:
        found = level_error(sweep)
        if found is None:
            return None
        return ChannelFinding(
            {"factor": (found.factor, found.standard_error, "1")}, np.zeros(len(sweep), bool)
        )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "it shows in the channels themselves"

    def story(self, u: Mapping[str, float]) -> str:
        return f"the base moves at {u['factor']:.4g} times the commanded level (velocity over it is right)"
