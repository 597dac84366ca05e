"""The mains in a channel: points near its multiples scatter."""

from collections.abc import Mapping

from fitting.effects.base import EVERY_STRUCTURE, ChannelFinding, Effect, Points
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.hum import mains_hum
from fitting.noise import Noise
from fitting.sweep import Sweep


class MainsHumEffect(Effect):
    """Seen in the scatter itself; its points are set aside, no unknown is fitted."""

    name = "mains_hum"
    enters = "channel"
    source = "outliers of the local scatter at multiples of 50 or 60 Hz"
    structures = EVERY_STRUCTURE
    discriminating_test = "a record with the shaker silent"

    def seen(self, sweep: Sweep, noise: Noise) -> ChannelFinding | None:
        hum = mains_hum(sweep, noise)
        if hum is None:
            return None
        nan = float("nan")
        return ChannelFinding(
            {"mains": (hum.mains_hz, nan, "Hz"), "size": (hum.size_m_s, nan, "m/s")}, hum.points
        )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "it shows in the channels themselves"

    def story(self, u: Mapping[str, float]) -> str:
        return f"the mains ({u['mains']:.0f} Hz) hums in a channel; the points at its multiples are set aside"
