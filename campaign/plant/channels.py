"""What the channels make of a motion: the vibrometer's delay and gain, what it reads, level, mains hum."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex

MAINS_HZ = 50.0
_AVERAGED_S = 1.0
"""Length of the sine fit at a point: hum leaks into it as sinc of its distance in frequency."""


@dataclass(frozen=True)
class TrueChannels:
    """Each channel as it really is; the defaults are as declared."""

    delay_s: float = 0.0
    gain: float = 1.0
    absolute: bool = False
    """The laser stands on the floor."""
    level: float = 1.0
    """The base moves by this factor times the command. Both channels see it: the reference shows it."""
    hum_m_s: float = 0.0
    """Mains and its multiples in the velocity channel, each of about this amplitude."""

    def velocity_per_acceleration(self, relative_s: Complex, omega: Array) -> Complex:
        """The reading over the base's true acceleration, of the plate's velocity relative to the clamp.

        In s, shape of `omega`.
        """
        seen = relative_s + 1 / (1j * omega) if self.absolute else relative_s
        return np.asarray(self.gain * np.exp(-1j * omega * self.delay_s) * seen)

    def hum(self, frequency_hz: Array, rng: np.random.Generator) -> Complex:
        """What hum adds to each reading in m/s, with a phase that no trigger holds. Shape (points,)."""
        count = len(frequency_hz)
        phase = rng.uniform(0, 2 * np.pi, count)
        size = self.hum_m_s * rng.uniform(0.5, 1.5, count)
        apart_hz = frequency_hz - MAINS_HZ * np.maximum(np.round(frequency_hz / MAINS_HZ), 1)
        return np.asarray(size * np.sinc(apart_hz * _AVERAGED_S) * np.exp(1j * phase))
