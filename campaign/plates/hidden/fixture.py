"""A fixture that yields between reference sensor and root, and pitches: of plates and of beams."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex


@dataclass(frozen=True)
class FixtureResonance:
    """The root moves by 1 + gain r^2/(1 - r^2) of the reference, r the frequency over that of the fixture."""

    name: ClassVar[str] = "fixture_resonance"
    near: ClassVar[tuple[str, ...]] = ("base_rocking",)

    frequency_hz: float
    damping_ratio: float
    gain: float
    pitch_rad_m: float
    """Per acceleration of the reference, times the same r^2/(1 - r^2)."""

    def _swing(self, omega: Array) -> Complex:
        r = omega / (2 * np.pi * self.frequency_hz)
        return np.asarray(r**2 / (1 - r**2 + 2j * self.damping_ratio * r))

    def root(self, omega: Array) -> Complex:
        """Acceleration of the root over that of the reference. Shape of `omega`, in rad/s."""
        return np.asarray(1 + self.gain * self._swing(omega))

    def pitch(self, omega: Array) -> Complex:
        """Angular acceleration per acceleration of the root, in rad/m. Shape of `omega`, in rad/s."""
        return np.asarray(self.pitch_rad_m * self._swing(omega) / self.root(omega))
