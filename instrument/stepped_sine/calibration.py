"""The vibrometer against the accelerometer on one point: gain and delay, in place.

With the laser on the base beside the accelerometer, reading over truth is

    V(f) i omega / A(f) = gain e^{-i omega delay}
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.errors import TooFewPoints
from instrument.stream.derived import CalibrationFound, PointMeasured

_LEAST_POINTS = 3
"""Gain and delay, and one to tell their scatter by."""


@dataclass(frozen=True)
class Calibration:
    """What the reading is to be divided by."""

    gain: float
    delay_s: float

    def true_velocity(self, frequency_hz: float, reading: complex) -> complex:
        """Gain and delay taken off a phasor."""
        return complex(reading / self.gain * np.exp(2j * np.pi * frequency_hz * self.delay_s))


def calibrate(points: list[PointMeasured], utc: str = "") -> CalibrationFound:
    """Gain and delay by least squares on ln of the ratio, weighted by its noise. Raises `TooFewPoints`.

    The phase is unwrapped from the lowest frequency up: steps must be narrower than half a turn of the delay.
    """
    if len(points) < _LEAST_POINTS:
        raise TooFewPoints(f"{len(points)} calibration points, expected {_LEAST_POINTS} or more")
    points = sorted(points, key=lambda p: float(p.frequency_hz))
    omega = 2 * np.pi * np.array([p.frequency_hz for p in points])
    a = np.array([p.base_m_s2 for p in points])
    v = np.array([p.velocity_m_s for p in points])
    ratio = v * 1j * omega / a
    v_std = np.array([p.velocity_std_m_s for p in points])
    a_std = np.array([p.base_accel_std_m_s2 for p in points])
    noise = np.hypot(v_std / np.abs(v), a_std / np.abs(a))
    weight = 1 / np.maximum(noise, 1e-6) ** 2
    ln_gain = float(weight @ np.log(np.abs(ratio)) / weight.sum())
    phase = np.unwrap(np.angle(ratio))
    delay = -float(weight @ (omega * phase) / (weight @ omega**2))
    gain_scatter = _scatter(np.log(np.abs(ratio)) - ln_gain, weight)
    delay_scatter = _scatter(phase + omega * delay, weight)
    return CalibrationFound(
        range_name=points[0].range_name,
        gain=float(np.exp(ln_gain)),
        delay_s=delay,
        gain_std=gain_scatter * float(np.exp(ln_gain)) / np.sqrt(weight.sum()),
        delay_std_s=delay_scatter / np.sqrt(float(weight @ omega**2)),
        points=len(points),
        utc=utc,
    )


def phase_left(points: Sequence[PointMeasured], delay_s: float) -> tuple[float, bool]:
    """What a delay leaves of the phases, and whether turning one sensor round explains it.

    Root mean square in rad, of one range's points.
    """
    points = sorted(points, key=lambda p: float(p.frequency_hz))
    omega = 2 * np.pi * np.array([p.frequency_hz for p in points])
    ratio = np.array([p.velocity_m_s / p.base_m_s2 for p in points]) * 1j * omega

    def left(phase: Array, seconds: float) -> float:
        return float(np.sqrt(np.mean((phase + omega * seconds) ** 2)))

    turned = np.unwrap(np.angle(-ratio))
    as_turned = left(turned, -float(omega @ turned / (omega @ omega)))
    as_it_is = left(np.unwrap(np.angle(ratio)), delay_s)
    return as_it_is, as_turned < as_it_is / 2


def _scatter(rest: Array, weight: Array) -> float:
    """Root of chi2 per degree of freedom, at least one."""
    return float(np.sqrt(max(1.0, float(weight @ rest**2) / (len(rest) - 1))))
