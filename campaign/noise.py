"""Scatter of a stepped-sine sweep, as seen in sweeps of the same plate whose noise figures are known.

What regressions of the squared scatter about a smooth curve found there (27 passes, 3200 points; shares
are of the square of what is named, in the part along and in the part across the response):
* `fraction_of_peak`: white complex noise on the velocity, E|n|^2 = (fraction x peak)^2, so a fraction over
  sqrt(2) of the peak in each part; the peak is that of the pass (one segment at one level). Found 0.50 and
  0.54 (+- 0.02).
* `floor_m_s`: the same kind of noise, of that size whatever the peak. Found 0.48 and 0.61 (+- 0.17).
* `repeat_scatter`: a complex factor on each reading, its real and imaginary parts each of that deviation.
  Found 1.2 and 0.6 (+- 0.25): a deviation per part fits best, a pure amplitude scatter worse.
* `drive_scatter`: the level of each point scatters by 0.3 % and its phase by 0.3 degrees; the reference
  channel follows, the velocity with it (slopes about 1), and the ratio does not know. The reference has
  no noise of its own that shows.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex

DRIVE_PHASE_RAD = np.deg2rad(0.3)


@dataclass(frozen=True)
class NoiseFigures:
    """How noisy a sweep is."""

    fraction_of_peak: float
    repeat_scatter: float
    floor_m_s: float = 2e-5
    drive_scatter: float = 0.003

    def std_m_s(self, clean_m_s: Complex, group: NDArray[np.intp]) -> Array:
        """Of each part of each reading. `group` numbers the passes. Shape (points,)."""
        size = np.abs(clean_m_s)
        white = np.hypot(self.fraction_of_peak * peaks(size, group), self.floor_m_s) / np.sqrt(2)
        return np.hypot(white, self.repeat_scatter * size)

    def drive(self, rng: np.random.Generator, count: int) -> Complex:
        """Factor on the base's motion. Shape (count,)."""
        level = 1 + self.drive_scatter * rng.standard_normal(count)
        return np.asarray(level * np.exp(1j * DRIVE_PHASE_RAD * rng.standard_normal(count)))

    def added(self, rng: np.random.Generator, clean_m_s: Complex, group: NDArray[np.intp]) -> Complex:
        """What the reading has beyond the clean velocity. Shape (points,)."""
        std = self.std_m_s(clean_m_s, group)
        return np.asarray(std * (rng.standard_normal(len(std)) + 1j * rng.standard_normal(len(std))))


def peaks(size: Array, group: NDArray[np.intp]) -> Array:
    """The largest size of each point's pass. Shape (points,)."""
    largest = {int(g): float(size[group == g].max()) for g in np.unique(group)}
    return np.array([largest[int(g)] for g in group])


_OF_PEAK = (0.003, 0.009)
"""Of a rig in use: about what the sweeps above were read with."""
_REPEATS = (0.0014, 0.0028)
"""The same of `repeat_scatter`."""


def draw_figures(rng: np.random.Generator, fraction_of_peak: tuple[float, float] = _OF_PEAK) -> NoiseFigures:
    """Figures of a rig in use."""
    return NoiseFigures(float(rng.uniform(*fraction_of_peak)), float(rng.uniform(*_REPEATS)))
