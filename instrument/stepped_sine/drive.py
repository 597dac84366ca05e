"""Which drive gives the level: from what the shaker's response was at the frequencies before."""

import numpy as np

_FAR = 0.05
"""Beyond this share of the frequency the gain is not carried over: a loop check measures it. A choice."""

_STEEP = 0.16
"""Of ln gain from one step to the next: a cube of the frequency over `_FAR` is less. A choice."""


class DriveModel:
    """Base acceleration per volt, as measured so far."""

    def __init__(self) -> None:
        self._gains: dict[float, float] = {}

    def learn(self, frequency_hz: float, gain_m_s2_v: float) -> None:
        """A gain measured."""
        self._gains[frequency_hz] = gain_m_s2_v

    def knows(self, frequency_hz: float) -> bool:
        """Whether a measured gain is near enough to begin with."""
        return any(abs(f / frequency_hz - 1) < _FAR for f in self._gains)

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
            change = -slope * ln_f[0]
            if change < -_STEEP:
                # Where the gain falls so fast it may turn before this frequency: either way the base stays
                # below its limit, and a correction takes it up.
                change = -change
            return float(level_m_s2 / np.exp(ln_gain[0] + change))
        return float(level_m_s2 / np.exp(ln_gain[0]))
