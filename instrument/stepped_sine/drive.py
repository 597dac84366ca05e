"""Which drive gives the level: from what the shaker's response was at the frequencies before."""

import numpy as np

FAR = 0.05
"""Beyond this share of the frequency the gain is not carried over: a loop check measures it. A choice."""

_STEEP = 0.1
"""Of ln gain: what it may change on the way from the nearest known gain without a loop check. A quarter of
the usual abort band: slopes grow where a resonance begins. One narrower than a step shows in none. A choice.
"""

_WINDOW = 0.15
"""Of ln frequency: slopes known within it say how steep the gain may be here. Three steps of `FAR`: two
gains alike on both sides of an anti-resonance do not hide it."""

_HOP = 1.1
"""Times the next drive: with more of it the frequency does not change. A choice."""


class DriveModel:
    """Base acceleration per volt, as measured so far."""

    def __init__(self) -> None:
        self._gains: dict[float, float] = {}

    def learn(self, frequency_hz: float, gain_m_s2_v: float) -> None:
        """A gain measured."""
        self._gains[frequency_hz] = gain_m_s2_v

    def knows(self, frequency_hz: float) -> bool:
        """Whether a measured gain is near enough to begin with, for how steep gains are hereabouts."""
        distance = min((abs(np.log(f / frequency_hz)) for f in self._gains), default=np.inf)
        near = any(abs(f / frequency_hz - 1) < FAR for f in self._gains)
        return near and distance * self._steepest(frequency_hz) <= _STEEP

    def drive_v(self, frequency_hz: float, level_m_s2: float) -> float:
        """The drive for a level: ln gain carried on along ln frequency from the two nearest gains.

        Raises `KeyError` where no gain is known.
        """
        near = sorted(self._gains, key=lambda f: abs(np.log(f / frequency_hz)))[:2]
        if not near:
            raise KeyError(frequency_hz)
        ln_f = np.log(frequency_hz / np.array(near))
        ln_gain = np.log([self._gains[f] for f in near])
        if len(near) == 2 and abs(ln_f[1] - ln_f[0]) > 1e-9:
            slope = (ln_gain[0] - ln_gain[1]) / (ln_f[0] - ln_f[1])
            return float(level_m_s2 / np.exp(ln_gain[0] - slope * ln_f[0]))
        return float(level_m_s2 / np.exp(ln_gain[0]))

    def _steepest(self, frequency_hz: float) -> float:
        """Of ln gain over ln frequency, between neighbours among the gains known nearby."""
        f = np.array(sorted(g for g in self._gains if abs(np.log(g / frequency_hz)) < _WINDOW))
        if len(f) < 2:
            return 0.0
        ln_gain = np.log([self._gains[x] for x in f])
        return float(np.abs(np.diff(ln_gain) / np.diff(np.log(f))).max())


def lowers_first(at_hz: float, drive_v: float, next_hz: float, next_drive_v: float) -> bool:
    """Whether the drive is lowered where it is, before the frequency changes.

    A frequency changes at once, an amplitude by its ramp: what is right beside an anti-resonance of the
    shaker would drive a resonance of it for as long.
    """
    return next_hz != at_hz and drive_v > _HOP * next_drive_v
