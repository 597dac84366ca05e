"""Rig time of a step: its drive comes up, its response comes to rest from scratch, and it is read."""

from collections.abc import Callable

import numpy as np

from fitting.arrays import Array, Complex
from fitting.specimen import PlateSpecimen
from instrument.check.forecast import OWN_RATIO
from instrument.stepped_sine.expected_time import settling_s, step_s
from instrument.stepped_sine.settings import SweepSettings

_REACH = 1.3
"""Modes up to this times the frequency count for the transient, as in `instrument.check.forecast`."""


def dwell_seconds(frequency_hz: Array, settings: SweepSettings) -> Array:
    """Seconds of the readings alone, without settling. Shape (points,)."""
    return np.array([settings.dwell_s(f) for f in frequency_hz])


def step_seconds(frequency_hz: Array, poles_hz: Complex, settings: SweepSettings) -> Array:
    """Of whole steps, each settling from nothing to the tolerance or for `most_s`. Shape (points,)."""
    decay = decay_of(poles_hz)
    return np.array([step_s(f, decay(f), settings) for f in frequency_hz])


def settle_seconds(frequency_hz: Array, poles_hz: Complex, settings: SweepSettings) -> Array:
    """Of the settling alone, whatever `most_s` is. Shape (points,)."""
    decay = decay_of(poles_hz)
    return np.array([settling_s(f, decay(f), settings) for f in frequency_hz])


def as_run(poles_hz: Complex, specimen: PlateSpecimen) -> Complex:
    """Poles with the damping that a run assumes of a bare plate where none is stated. Shape as given."""
    return poles_hz if specimen.modal_ratios else poles_hz + 1j * OWN_RATIO * poles_hz.real


def decay_of(poles_hz: Complex) -> Callable[[float], float]:
    """The slowest free decay, in 1/s, that a step near a frequency stirs. `poles_hz`: shape (poles,)."""

    def decay(frequency_hz: float) -> float:
        near = poles_hz.real <= _REACH * frequency_hz
        every = 2 * np.pi * poles_hz.imag
        return float(every[near].min() if near.any() else every[np.argmin(poles_hz.real)])

    return decay
