"""A channel is AC coupled: a first-order high pass takes from the lowest resonances."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import Points


class AcCouplingEffect(Effect):
    """Velocity times (i f / f_c) / (1 + i f / f_c), which is 1 / (1 - i f_c / f)."""

    name = "ac_coupling"
    enters = "channel"
    source = "first-order filter: the input's series capacitor"
    structures = EVERY_STRUCTURE
    parameters = (EffectParameter("corner", "Hz", 0.0, 5.0, 0.5, spread=1.0),)
    chance = 0.015
    discriminating_test = "the channel's input set to DC; the laser on the base beside the accelerometer"

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        f = points.omega / (2 * np.pi)
        return np.asarray(v / (1 - 1j * u[0] / f))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the velocity channel is a high pass with its corner at {u['corner']:.3g} Hz"
