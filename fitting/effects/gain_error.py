"""The velocity channel's gain is not what it is taken for."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import Points


class GainErrorEffect(Effect):
    """Velocity times a real factor."""

    name = "gain_error"
    enters = "channel"
    source = "calibration of the measuring chain"
    structures = EVERY_STRUCTURE
    parameters = (EffectParameter("factor", "1", 0.4, 2.5, 1.02, neutral=1.0, spread=0.02),)
    chance = 0.04
    discriminating_test = "the laser on the base beside the accelerometer; a second spot"

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        return np.asarray(v * u[0])

    def story(self, u: Mapping[str, float]) -> str:
        off = 100 * (u["factor"] - 1)
        return f"the velocity channel reads {abs(off):.2f} % {'high' if off > 0 else 'low'}"
