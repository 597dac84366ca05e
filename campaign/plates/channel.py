"""How far a velocity channel is off within its tolerance."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from campaign.plates.stated import CampaignTolerances
from fitting.arrays import Array, Complex


@dataclass(frozen=True)
class ChannelError:
    """What it makes of a velocity beside what is said of it."""

    gain: float = 1.0
    delay_s: float = 0.0
    phase_rad: float = 0.0

    @classmethod
    def within(cls, tolerances: CampaignTolerances, off: Sequence[float] | Array) -> "ChannelError":
        """Gain, delay and phase that are off by so many standard deviations. Shape (3,)."""
        t, (gain, delay, phase) = tolerances, (float(z) for z in off)
        return cls(float(np.exp(t.gain * gain)), t.delay_s * delay, t.phase_rad * phase)

    def factor(self, omega: Array) -> Complex:
        """On a velocity. Shape (points,)."""
        return np.asarray(self.gain * np.exp(1j * (self.phase_rad - omega * self.delay_s)))
