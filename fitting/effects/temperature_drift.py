"""The core warms during the sweep: its times shorten as the sweep goes on."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter, ModulusAt, Points
from fitting.effects.enriched_plate import EnrichedReducedPlate

C_1, C_2_K = 9.0, 120.0
"""Of a damping polymer well above its glass transition; another pair scales the kelvins found."""


def time_scale(warmer_k: Array | float) -> Array:
    """a_T: what a core's times shorten by where it is so much warmer. Of the shape of `warmer_k`."""
    return np.asarray(10 ** (-C_1 * warmer_k / (C_2_K + warmer_k)))


class TemperatureDriftEffect(Effect):
    """tau times a_T, log10 a_T = -C_1 T / (C_2 + T), T = warming (1 - exp(-t / time_constant))."""

    name = "temperature_drift"
    enters = "time"
    source = "Williams, Landel and Ferry, J. Am. Chem. Soc. 77 (1955)"
    structures = EVERY_STRUCTURE
    parameters = (
        EffectParameter("warming", "K", -25.0, 25.0, 2.0, spread=5.0),
        EffectParameter("time_constant", "s", 20.0, 1e5, 600.0, logarithmic=True, neutral=None),
    )
    chance = 0.04
    discriminating_test = "the first segment repeated at the end, or the order of the segments reversed"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        if not points.timed and len(points.omega) > 30:
            return "the points carry no time"
        return None

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        duration = max(float(np.ptp(points.time_s)), 40.0)
        return [np.array([2.0, share * duration]) for share in (0.2, 0.6, 3.0)]

    def modulus(self, G: ModulusAt, points: Points, u: Array) -> Complex:
        kelvin = -u[0] * np.expm1(-points.time_s / u[1])
        return G(time_scale(kelvin))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the core warms by {u['warming']:.2g} K in the end, within {u['time_constant'] / 60:.2g} min"
