"""The mains in a channel: points near its multiples scatter."""

from collections.abc import Mapping

import numpy as np

from fitting.data.hum import SPREAD_HZ, HumSeen, mains_hum
from fitting.data.noise import Noise, noise_of
from fitting.data.strays import strays
from fitting.effects.base import EVERY_STRUCTURE, ChannelFinding, Effect
from fitting.effects.given import Points
from fitting.numerics.chances import binomial_above
from fitting.sweep import Sweep
from fitting.widened.enriched_plate import EnrichedReducedPlate

_BY_CHANCE = 0.01
"""How likely stray readings must be to lie near multiples by chance, for no hum to be named. A choice."""


class MainsHumEffect(Effect):
    """Seen in the scatter itself; its points are set aside, no unknown is fitted."""

    name = "mains_hum"
    enters = "channel"
    source = "outliers of the local scatter at multiples of 50 or 60 Hz"
    structures = EVERY_STRUCTURE
    discriminating_test = "a record with the shaker silent"

    def seen(self, sweep: Sweep, noise: Noise) -> ChannelFinding | None:
        hum = mains_hum(sweep, noise)
        if hum is None or _are_strays(sweep, hum):
            return None
        nan = float("nan")
        return ChannelFinding(
            {"mains": (hum.mains_hz, nan, "Hz"), "size": (hum.size_m_s, nan, "m/s")}, hum.points
        )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "it shows in the channels themselves"

    def story(self, u: Mapping[str, float]) -> str:
        return f"the mains ({u['mains']:.0f} Hz) hums in a channel; the points at its multiples are set aside"


def _are_strays(sweep: Sweep, hum: HumSeen) -> bool:
    """Whether readings are lost far from any multiple too, and what is near one may be some of them.

    Without them nothing may be left that hums.
    """
    f, stray = sweep.frequency_hz, strays(sweep) > 0
    lines = [k * hum.mains_hz for k in hum.multiples]
    near = np.any([np.abs(f - line) <= SPREAD_HZ for line in lines], axis=0)
    count, here = int(stray.sum()), int((stray & near).sum())
    if here in (0, count) or binomial_above(here - 1, count, near.mean()) < _BY_CHANCE:
        return False
    left = sweep.take(~stray)
    return mains_hum(left, noise_of(left)) is None
