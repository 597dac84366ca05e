"""Scatter of a sweep: white as in the campaign on one plate, and what drifts in the order of measurement."""

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from campaign.noise import NoiseFigures, draw_figures
from campaign.schedule import Schedule
from fitting.arrays import Complex

_WHITE_SHARE = 0.5
"""Of cases; the others drift as well, in one of two ways."""
_WANDER, _WANDER_POINTS = (0.0008, 0.0025), (4, 25)
"""Size of a walk, about that of the white scatter; readings over which it forgets, less than a segment."""
_SWING, _TURNS = (0.001, 0.004), (0.3, 0.8)
"""Size of a slow swing of the gain, and turns of it in a segment: no smooth law looks like a whole one."""


@dataclass(frozen=True)
class PlateNoise:
    """How noisy a sweep is."""

    white: NoiseFigures
    wander: float = 0.0
    """Of a complex factor on the reading, in each part: an AR(1) walk from reading to reading."""
    wander_points: float = 1.0
    """Readings over which it forgets."""
    gain_drift: float = 0.0
    """Amplitude of a slow swing of the gain within a segment."""

    def factor(self, rng: np.random.Generator, schedule: Schedule) -> Complex:
        """On each reading. Shape (points,)."""
        count = len(schedule.frequency_hz)
        factor = np.ones(count, complex)
        in_time = np.argsort(schedule.time_s)
        if self.wander:
            keep = np.exp(-1 / self.wander_points)
            kicks = rng.standard_normal((count, 2)) @ np.array([1, 1j])
            # The first kick alone is the walk's start, of its whole size.
            kicks[1:] *= np.sqrt(1 - keep**2)
            factor[in_time] += self.wander * lfilter([1.0], [1.0, -keep], kicks)
        if self.gain_drift:
            for number in np.unique(schedule.sweep):
                inside = np.flatnonzero(schedule.sweep == number)
                t = schedule.time_s[inside]
                share = (t - t.min()) / max(float(np.ptp(t)), 1e-9)
                turns, phase = rng.uniform(*_TURNS), rng.uniform(0, 2 * np.pi)
                factor[inside] *= 1 + self.gain_drift * np.sin(2 * np.pi * turns * share + phase)
        return factor


def draw_noise(rng: np.random.Generator) -> PlateNoise:
    """Figures of a rig in use."""
    white = draw_figures(rng)
    kind, size = rng.random(), float(rng.uniform(*_WANDER))
    points, swing = float(rng.uniform(*_WANDER_POINTS)), float(rng.uniform(*_SWING))
    if kind < _WHITE_SHARE:
        return PlateNoise(white)
    if kind < (1 + _WHITE_SHARE) / 2:
        return PlateNoise(white, size, points)
    return PlateNoise(white, gain_drift=swing)
