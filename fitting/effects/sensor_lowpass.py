"""The vibrometer's decoder rolls off early: a first-order low pass in the velocity channel."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import EVERY_STRUCTURE, Effect, EffectParameter
from fitting.effects.given import Points


class SensorLowpassEffect(Effect):
    """Velocity over 1 + i f / f_c."""

    name = "sensor_lowpass"
    enters = "channel"
    source = "first-order filter, e.g. a decoder's output filter or a long cable on a high source impedance"
    structures = EVERY_STRUCTURE
    parameters = (
        EffectParameter("corner", "Hz", 200.0, 1e5, 3000.0, logarithmic=True, neutral=float("inf")),
    )
    discriminating_test = (
        "another low-pass setting of the decoder; the laser on the base beside the accelerometer"
    )

    def reading(self, v: Complex, points: Points, u: Array) -> Complex:
        f = points.omega / (2 * np.pi)
        return np.asarray(v / (1 + 1j * f / u[0]))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the velocity channel is a low pass with its corner at {u['corner']:.3g} Hz"
