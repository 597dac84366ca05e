"""The core of one file was at another temperature than that of the others."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import ModulusAt, Points
from fitting.effects.temperature_drift import time_scale
from fitting.widened.enriched_plate import EnrichedReducedPlate


class TemperatureDifferenceEffect(Effect):
    """G*(omega a_T) in the file that is warmer, one temperature in all of it.

    One file alone has a law of its own temperature: nothing shows there.
    """

    name = "temperature_difference"
    enters = "time"
    source = "Williams, Landel and Ferry, J. Am. Chem. Soc. 77 (1955)"
    structures = EVERY_STRUCTURE
    between_files = True
    parameters = (EffectParameter("warmer", "K", -25.0, 25.0, 2.0, spread=3.0),)
    chance = 0.15
    discriminating_test = "the first file measured again, with a thermometer at the core for each"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "it lies between files, and there is one"

    def modulus(self, G: ModulusAt, points: Points, u: Array) -> Complex:
        return G(np.full(len(points.omega), time_scale(u[0])))

    def story(self, u: Mapping[str, float]) -> str:
        warmer = u["warmer"]
        return f"the core is {abs(warmer):.2g} K {'warmer' if warmer > 0 else 'colder'}"
