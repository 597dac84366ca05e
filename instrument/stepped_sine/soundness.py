"""What a reading says of itself: whether its sine is at the frequency it is fitted at, and whole.

A fit at a known frequency gives a number for anything. A shaker that did not follow, or clocks that do not
agree, turn the phasor while it is read; a sensor or an input that saturates makes a flat top.
"""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from instrument.stepped_sine.sine_fit import SineFit, sine_fit

MOST_OFF, MARKED_OFF = 1e-3, 2e-4
"""Relative, of the frequency: beyond the first a point is none, beyond the second it is marked. Quartz agrees
within a ten-thousandth, and a thousandth is 0.2 % of stiffness. A choice."""
CLEAR = 5.0
"""Standard deviations by which it has to be off."""
MARKED_DISTORTION = 0.05
"""Of the fundamental: from there on a point says so. A choice."""
FLAT_DISTORTION = 0.02
"""Less than this a flat top does not make."""
_OVER_NOISE = 2.0
"""Times what noise alone makes of all harmonics together: of four that is one in ten thousand."""
_TOP, _SIDE = 0.02, 0.125
"""A sine is within 2 % of its amplitude of one peak for 6.4 % of the time; one whose peak is cut by a tenth
for 14 %, and so is none with less than 7 % of a harmonic. A choice."""


@dataclass(frozen=True)
class Fault:
    """What makes a reading none: the quantity, its value and limit in a unit, and what to do about it."""

    what: str
    value: float
    limit: float
    unit: str
    remedy: str


@dataclass(frozen=True)
class Soundness:
    """What a reading says of itself: a fault of the base, whose sine all else hangs on, or remarks."""

    fault: Fault | None = None
    velocity_is_flat: bool = False
    remarks: tuple[str, ...] = ()


def soundness(x: Array, first: int, sample_rate_hz: float, frequency_hz: float, fit: SineFit) -> Soundness:
    """Of a reading from sample `first` on, shape (channels, samples): base, velocity, others; SI units."""
    off, noise = frequency_off(x[0], first, sample_rate_hz, frequency_hz)
    clear = abs(off) > CLEAR * noise
    if clear and abs(off) > MOST_OFF:
        return Soundness(_other_frequency(off))
    if is_flat(x, fit, 0):
        return Soundness(_flat_base(fit))
    flat = is_flat(x, fit, 1)
    remarks = ["velocity has a flat top: does the laser or its input saturate?"] if flat else []
    if clear and abs(off) > MARKED_OFF:
        remarks.append(f"frequency {100 * off:+.2g} % off by the front-end's clock")
    for name, share, marked in zip(("base", "velocity"), fit.distortion, distorted(fit), strict=False):
        if marked:
            remarks.append(f"{name} distorted: harmonics of {100 * float(share):.2g} %")
    return Soundness(None, flat, tuple(remarks))


def _other_frequency(off: float) -> Fault:
    return Fault(
        "frequency at the base, by the front-end's clock, off by",
        100 * abs(off),
        100 * MOST_OFF,
        "%",
        "does the shaker run at the frequency it is told? do its clock and the front-end's agree, "
        "is the sample rate right?",
    )


def _flat_base(fit: SineFit) -> Fault:
    return Fault(
        "base acceleration has a flat top, harmonics",
        100 * float(fit.distortion[0]),
        100 * FLAT_DISTORTION,
        "%",
        "accelerometer, its input or the amplifier saturates: lower the level or raise range_v",
    )


def frequency_off(base: Array, first: int, sample_rate_hz: float, frequency_hz: float) -> tuple[float, float]:
    """By how much the sine is off its frequency, and the standard deviation of that; relative.

    From the phases of the two halves of the record, shape (samples,), beginning at sample `first`.
    """
    half = len(base) // 2
    halves = (
        sine_fit(base[None, k * half : (k + 1) * half], first + k * half, sample_rate_hz, frequency_hz)
        for k in (0, 1)
    )
    (a, a_std), (b, b_std) = ((fit.phasor[0], fit.std[0]) for fit in halves)
    turns_to_relative = 1 / (2 * np.pi * frequency_hz * half / sample_rate_hz)
    off = float(np.angle(b * np.conj(a))) * turns_to_relative
    noise = float(np.hypot(a_std / max(abs(a), _TINY), b_std / max(abs(b), _TINY))) * turns_to_relative
    return off, noise


def distorted(fit: SineFit) -> tuple[bool, ...]:
    """Of each channel whether its harmonics stand out of the noise and are more than `MARKED_DISTORTION`."""
    higher = fit.harmonics.shape[1] - 1
    noise = np.sqrt(2 * higher) * fit.std / np.maximum(np.abs(fit.phasor), _TINY)
    more = np.sqrt(np.maximum(fit.distortion**2 - noise**2, 0.0))
    return tuple((more > MARKED_DISTORTION) & (fit.distortion > _OVER_NOISE * noise))


def is_flat(x: Array, fit: SineFit, channel: int) -> bool:
    """Whether a channel's record, of x (channels, samples), has a flat top or bottom."""
    if fit.distortion[channel] < FLAT_DISTORTION:
        return False
    low, high = np.percentile(x[channel], (0.5, 99.5))
    room = _TOP * (high - low) / 2
    return bool(max(np.mean(x[channel] > high - room), np.mean(x[channel] < low + room)) > _SIDE)


_TINY = float(np.finfo(float).tiny)
