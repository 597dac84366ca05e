"""The velocity channel picks up some of the base's: cables side by side, a shared ground."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import Points


class CrossTalk(Effect):
    """Velocity plus a share of the base's acceleration."""

    name = "crosstalk"
    enters = "channel"
    source = "capacitive and resistive coupling of measuring cables"
    structures = EVERY_STRUCTURE
    parameters = (EffectParameter("leak", "mm/s per m/s^2", -5.0, 5.0, 0.05, spread=0.1),)
    chance = 0.01
    discriminating_test = "a short across the velocity input while the shaker runs: what is left leaks"

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        """Both channels are phasors with the base's acceleration as their reference."""
        return np.asarray(v + 1e-3 * u[0] * points.drive_amplitude)

    def story(self, u: Mapping[str, float]) -> str:
        """For the verdict."""
        return f"the velocity channel picks up {u['leak']:+.3g} mm/s for each m/s^2 of the base"
