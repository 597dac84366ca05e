"""From what moves to what a converter counts: sensitivity, noise, hum, clipping, quantisation."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.arrays import Array

COUNTS = 2**23
"""A 24-bit converter's full scale."""
_CLIP = 1.02
"""A device's output goes so far over its full scale."""
_THIRD_HARMONIC = 0.3
"""Of mains hum."""


@dataclass(frozen=True)
class SimulatedSensor:
    """What hangs on an input."""

    quantity: str
    """Name of the plant's output, or of a constant."""
    volts_per_unit: float
    """Signed."""
    noise_v: float
    """Standard deviation of white noise."""
    limit_v: float
    """The sensor's own output ends there."""


@dataclass(frozen=True)
class Converted:
    """A channel's samples."""

    counts: NDArray[np.int32]
    overload: bool


class Input:
    """One input of the front-end: its own noise, the same whatever the blocks are cut into."""

    def __init__(
        self, sensor: SimulatedSensor, full_scale_v: float, range_v: float, seed: tuple[int, ...]
    ) -> None:
        self.sensor = sensor
        self._full_scale_v, self._range_v = full_scale_v, range_v
        self._random = np.random.default_rng(seed)

    def convert(self, signal: Array, hum_v: Array) -> Converted:
        """Counts of a signal in the sensor's unit. Shape (samples,)."""
        s = self.sensor
        volts = np.clip(signal * s.volts_per_unit, -_CLIP * s.limit_v, _CLIP * s.limit_v) + hum_v
        if s.noise_v:
            volts = volts + s.noise_v * self._random.standard_normal(len(volts))
        counts = np.rint(volts * (COUNTS / self._full_scale_v))
        overload = bool(np.abs(volts).max(initial=0.0) > self._range_v)
        return Converted(np.clip(counts, -COUNTS, COUNTS - 1).astype(np.int32), overload)


def hum(amplitude_v: float, mains_hz: float, first_s: float, step_s: float, count: int) -> Array:
    """What the mains put on a cable, in V. Shape (count,)."""
    if not amplitude_v:
        return np.zeros(count)
    angle = 2 * np.pi * mains_hz * (first_s + step_s * np.arange(count))
    return np.asarray(amplitude_v * (np.sin(angle) + _THIRD_HARMONIC * np.sin(3 * angle)))
