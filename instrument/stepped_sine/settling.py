"""Has the response come to rest? Told from the drift of its phasor, and how it dies away.

A transient of one mode leaves x_k = x_0 q^k in the phasors of successive blocks of length T,
|q| = e^{-sigma T}. Over m blocks it moves by d_k = |x_k| |q^{-m} - 1|, at least |x_k| (|q|^{-m} - 1):
what is left is

    |x_k| <= d_k |q|^m / (1 - |q|^m)

whatever its frequency is: a beat cannot hide it. Over one block that factor is large where a mode decays
slowly, and noise alone looks like much that is left; over as many blocks as halve a transient it is one. What
has been bounded once dies away as e^{-sigma t} from there.

sigma is the specimen's as it is known, and a law may be stated wrongly: d_k itself falls as |q|^k, beats or
not, so that a decay which is slower than stated shows while the drift stands out of its noise.
"""

from dataclasses import dataclass, field

import numpy as np

_RESOLVED = 3.0
"""A drift below so many standard deviations is noise."""
_CLEAR = 5.0
"""The decay is read from drifts above so many standard deviations: a fifth of a fall by e, at worst ..."""
_LEAST_FALL = 1.0
"""... and from a fall by e at least."""
_SLOWER = 0.1
"""Of the decay as it is known: what seems slower is no transient (hum, for instance)."""
_EARLY = 2.0
"""A transient stands out of its noise within so many decay times, or not at all."""
_SLOWEST_1_S = 1e-6
"""What has no damping at all never settles: weeks are as good as that."""
_NOTHING_KNOWN = 1e300
"""A bound before there is one: finite, so that it may die away."""
_TINY = float(np.finfo(float).tiny)
"""In place of a response of nothing: what is left of it is no share of it."""


@dataclass
class Settling:
    """Follows one step, block by block."""

    decay_1_s: float
    """sigma of the slowest transient expected; less where the drift shows that."""
    tolerance: float
    """Relative, of the response."""
    readings: list[complex] = field(default_factory=list)
    remaining: float = np.inf
    """Bound on what is left of the transient, relative, its noise counted."""
    noise: float = 0.0
    """What noise alone makes of a bound by this block's drift."""
    predicted_s: float = np.inf
    """Since the first reading, from the first drift and the decay expected."""
    elapsed_s: float = 0.0
    _expected_1_s: float = 0.0
    _bound: float = _NOTHING_KNOWN
    """On what is left, in the response's own unit."""
    _first_clear: tuple[float, float] | None = None
    """Time, and drift over as many blocks as halve a transient, of the first that stands out of its noise."""

    def __post_init__(self) -> None:
        self.decay_1_s = self._expected_1_s = max(self.decay_1_s, _SLOWEST_1_S)

    def add(self, response: complex, relative_std: float, block_s: float) -> bool:
        """Take a block's response; whether it has settled by now."""
        self.readings.append(response)
        if len(self.readings) < 2:
            return False
        self.elapsed_s += block_s
        halving = max(1, int(np.ceil(np.log(2) / (self._expected_1_s * block_s))))
        lag = min(halving, len(self.readings) - 1)
        size = max(abs(response), _TINY)
        drift, std = abs(response - self.readings[-1 - lag]), np.sqrt(2) * relative_std * size
        if lag == halving:
            self._look_at_decay(drift, std)
        left = np.exp(-self.decay_1_s * block_s)
        share = left**lag / (1 - left**lag)
        self._bound = float(min(self._bound * left, (drift + _RESOLVED * std) * share))
        self.remaining, self.noise = self._bound / size, float(_RESOLVED * std * share / size)
        if len(self.readings) == 2:
            excess = max(self.remaining / self.tolerance, 1.0)
            self.predicted_s = float(np.log(excess) / self.decay_1_s) + block_s
        return self.remaining <= self.tolerance

    def _look_at_decay(self, drift: float, std: float) -> None:
        """What is left is bounded by a drift that stands out of its noise alone; and that shows the decay."""
        usual, now = self._expected_1_s, self.elapsed_s
        if drift <= _CLEAR * std:
            return
        # Two modes may have hidden each other for a moment: what was bounded then does not count.
        self._bound = _NOTHING_KNOWN
        if self._first_clear is None:
            self._first_clear = now, drift
        since, first = self._first_clear
        fall, decay_times = np.log(first / drift), (now - since) * usual
        if since * usual <= _EARLY and max(abs(fall), decay_times / _EARLY) >= _LEAST_FALL:
            slower = float(fall / decay_times)
            self.decay_1_s = usual * (slower if _SLOWER <= slower < 1 else 1.0)
