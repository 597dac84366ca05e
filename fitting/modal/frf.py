"""A frequency response function and what an estimator says of a mode in it."""

from dataclasses import dataclass, replace
from math import hypot
from typing import Literal

import numpy as np

from fitting.arrays import Array, Complex

Motion = Literal["displacement", "velocity", "acceleration"]


@dataclass(frozen=True)
class Frf:
    """Motion over force on evenly or unevenly spaced lines, ascending."""

    frequency_hz: Array
    H: Complex
    """Receptance, mobility or accelerance. Shape (lines,)."""
    motion: Motion
    added_decay_1_s: float = 0.0
    """Decay rate an exponential window has added to every mode, in 1/s."""

    @property
    def omega(self) -> Array:
        """rad/s. Shape (lines,)."""
        return 2 * np.pi * self.frequency_hz

    def between(self, low_hz: float, high_hz: float) -> "Frf":
        """The lines in a closed band."""
        inside = (self.frequency_hz >= low_hz) & (self.frequency_hz <= high_hz)
        return Frf(self.frequency_hz[inside], self.H[inside], self.motion, self.added_decay_1_s)


@dataclass(frozen=True)
class DampingEstimate:
    """Damping of one mode by one method, what a window added taken off."""

    frequency_hz: float
    """Undamped natural frequency."""
    ratio: float
    """Fraction of critical."""
    standard_error: float
    """Of `ratio`, by the scatter of the data about the method's model; NaN where it has none."""
    frequency_error_hz: float = float("nan")
    """Standard error of the frequency; NaN where the method does not say."""

    def off_by(self, other: "DampingEstimate") -> "DampingEstimate":
        """The estimate known so much worse as another way of reading it differs."""
        return self.wider(abs(other.ratio - self.ratio), abs(other.frequency_hz - self.frequency_hz))

    def wider(self, ratio: float, frequency_hz: float) -> "DampingEstimate":
        """With these errors besides its own."""
        return replace(
            self,
            standard_error=hypot(self.standard_error, ratio),
            frequency_error_hz=hypot(self.frequency_error_hz, frequency_hz),
        )


@dataclass(frozen=True)
class Refusal:
    """Why a method gives no value."""

    why: str


def is_near(frequency_hz: float, near_hz: float) -> bool:
    """Whether a mode found is the one asked for: within 5 %."""
    return abs(frequency_hz - near_hz) <= 0.05 * near_hz


def corrected(frequency_hz: float, ratio: float, added_decay_1_s: float) -> tuple[float, float]:
    """Natural frequency and ratio without what an exponential window exp(-t/T_w) added to the decay, 1/T_w.

    The damped frequency is as it was; the modulus of the pole is not.
    """
    if not added_decay_1_s:
        return frequency_hz, ratio
    omega = 2 * np.pi * frequency_hz
    decay = ratio * omega - added_decay_1_s
    own = float(np.hypot(omega * np.sqrt(1 - ratio**2), decay))
    return own / (2 * np.pi), decay / own
