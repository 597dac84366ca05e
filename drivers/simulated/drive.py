"""What a simulated generator puts out: pieces of a sine, phase continuous, each of linear amplitude."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class DrivePiece:
    """u(t) = (amplitude_v + slope_v_s (t - begin_s)) sin(2 pi frequency_hz (t - begin_s) + phase_rad).

    Holds from `begin_s` until the next piece begins. Times are those of the sample counter: sample / rate.
    """

    begin_s: float
    frequency_hz: float
    amplitude_v: float
    slope_v_s: float
    phase_rad: float

    def amplitude_at(self, time_s: float) -> float:
        """Amplitude in V."""
        return self.amplitude_v + self.slope_v_s * (time_s - self.begin_s)

    def phase_at(self, time_s: float) -> float:
        """Phase in rad."""
        return self.phase_rad + 2 * np.pi * self.frequency_hz * (time_s - self.begin_s)
