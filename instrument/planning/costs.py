"""Rig time of a step: its drive comes up, its response comes to rest from scratch, and it is read."""

from collections.abc import Callable

import numpy as np

from fitting.arrays import Array, Complex
from instrument.stepped_sine.settings import SweepSettings

_REACH = 1.3
"""Modes up to this times the frequency count for the transient, as in `instrument.check.forecast`."""


def dwell_seconds(frequency_hz: Array, settings: SweepSettings) -> Array:
    """Of the readings alone. Shape (points,)."""
    return np.array([settings.dwell_s(f) for f in frequency_hz])


def step_seconds(frequency_hz: Array, poles_hz: Complex, settings: SweepSettings) -> Array:
    """Of whole steps, each settling from nothing to the tolerance. Shape (points,)."""
    decay = decay_of(poles_hz)
    wait = float(np.log(1 / settings.settle.tolerance))
    return np.array(
        [
            settings.control.ramp_s
            + 2 * settings.block_s(f)
            + min(wait / decay(f), settings.settle.most_s)
            + settings.dwell_s(f)
            for f in frequency_hz
        ]
    )


def decay_of(poles_hz: Complex) -> Callable[[float], float]:
    """The slowest free decay, in 1/s, that a step near a frequency stirs. `poles_hz`: shape (poles,)."""

    def decay(frequency_hz: float) -> float:
        near = poles_hz.real <= _REACH * frequency_hz
        every = 2 * np.pi * poles_hz.imag
        return float(every[near].min() if near.any() else every[np.argmin(poles_hz.real)])

    return decay
