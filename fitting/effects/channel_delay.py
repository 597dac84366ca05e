"""The velocity channel lags behind the reference."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate


class ChannelDelayEffect(Effect):
    """Velocity times e^{-i omega delay}."""

    name = "channel_delay"
    enters = "channel"
    source = "a decoder's or filter's constant group delay"
    structures = EVERY_STRUCTURE
    parameters = (EffectParameter("delay", "s", -3e-3, 3e-3, 5e-5, spread=1e-4),)
    chance = 0.04
    discriminating_test = (
        "the laser on the base beside the accelerometer: its phase over frequency is the delay"
    )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if points.has_phase else "amplitudes do not show a delay"

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        return np.asarray(v * np.exp(-1j * points.omega * u[0]))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the velocity channel lags by {1e6 * u['delay']:.3g} microseconds"
