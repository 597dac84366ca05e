"""Has the response come to rest? Told from the drift of its phasor from block to block.

A transient of one mode leaves x_k = x_0 q^k in the phasors of successive blocks, |q| = e^{-sigma T}. Between
two blocks it moves by d_k = |x_k| |1/q - 1|, and |1/q - 1| >= 1/|q| - 1, so that what is left is at most

    |x_k| <= d_k |q| / (1 - |q|)

whatever its frequency is: a beat cannot hide it.
"""

from dataclasses import dataclass, field

import numpy as np

_RESOLVED = 3.0
"""A drift below so many standard deviations is noise."""


@dataclass
class Settling:
    """Follows one step, block by block."""

    decay_1_s: float
    """sigma of the slowest transient expected."""
    tolerance: float
    """Relative, of the response."""
    readings: list[complex] = field(default_factory=list)
    remaining: float = np.inf
    """Bound on what is left of the transient, relative."""
    noise: float = 0.0
    """What noise alone makes of that bound: a transient below it cannot be seen."""
    predicted_s: float = np.inf
    """Since the first reading, from the first drift and the decay expected."""
    elapsed_s: float = 0.0

    def add(self, response: complex, relative_std: float, block_s: float) -> bool:
        """Take a block's response; whether it has settled by now."""
        self.readings.append(response)
        if len(self.readings) < 2:
            return False
        self.elapsed_s += block_s
        drift = abs(response - self.readings[-2]) / abs(response)
        q = np.exp(-self.decay_1_s * block_s)
        self.remaining = float(drift * q / (1 - q))
        self.noise = float(_RESOLVED * np.sqrt(2) * relative_std * q / (1 - q))
        if len(self.readings) == 2:
            excess = max(self.remaining / self.tolerance, 1.0)
            self.predicted_s = float(np.log(excess) / self.decay_1_s) + block_s
        if self.remaining <= self.tolerance:
            return True
        resolved = drift > _RESOLVED * np.sqrt(2) * relative_std
        return not resolved and self.elapsed_s >= self.predicted_s
