"""Single readings that are no readings: the laser lost its speckle, a channel was over its range."""

from collections.abc import Mapping

import numpy as np

from fitting.data.noise import Noise
from fitting.data.strays import strays
from fitting.effects.base import EVERY_STRUCTURE, ChannelFinding, Effect
from fitting.effects.given import Points
from fitting.sweep import Sweep
from fitting.widened.enriched_plate import EnrichedReducedPlate


class SignalDropoutEffect(Effect):
    """Seen beside their neighbours; its points are set aside, no unknown is fitted."""

    name = "signal_dropout"
    enters = "channel"
    source = "readings far off the curve of their neighbours"
    structures = EVERY_STRUCTURE
    discriminating_test = "these frequencies read again, the laser on fresh retro-reflective tape"

    def seen(self, sweep: Sweep, noise: Noise) -> ChannelFinding | None:
        off = strays(sweep)
        out = off > 0
        if not out.any():
            return None
        nan = float("nan")
        values = {"readings": (float(out.sum()), nan, "1"), "size": (float(off.max()), nan, "m/s")}
        return ChannelFinding(values, np.asarray(out))

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "it shows in the channels themselves"

    def story(self, u: Mapping[str, float]) -> str:
        count = f"{u['readings']:.0f} readings leave" if u["readings"] > 1 else "one reading leaves"
        return f"{count} the curve of the readings beside by far (a signal lost?), set aside"
