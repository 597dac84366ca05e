"""The points of a sweep, at which levels, and when each is read."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex, Integers
from fitting.sweep import Sweep

THREE_LEVELS_G = (0.25, 0.5, 1.0)
"""A factor of two apart: what depends on level shows, and the lowest still stands out of the noise."""
_ONE_LEVEL_SHARE = {"amplitude_softening": 1 / 3}
"""Of cases at 1 g alone, where levels tell something; `_ONE_LEVEL_ELSE` of all others."""
_ONE_LEVEL_ELSE = 0.9
LATE_S = 0.05
"""Mean of what a point takes beyond settling and reading, exponentially distributed."""
_BETWEEN_S = (40.0, 160.0)
"""From one pass to the next: what the rig and whoever stands by take."""


@dataclass(frozen=True)
class Pass:
    """One segment at one level."""

    segment: int
    frequency_hz: Array
    """Ascending. Shape (points,)."""
    level_g: float
    time_s: Array
    """When each point is read. Shape (points,)."""


@dataclass(frozen=True)
class Schedule:
    """Points in the order of their frequencies, pass by pass. Shape (points,) each."""

    frequency_hz: Array
    segment: Integers
    sweep: Integers
    """Number of the pass, in order of time: one segment at one level."""
    level_g: Array
    time_s: Array
    """When the point was read."""

    @classmethod
    def of_passes(cls, passes: Sequence[Pass]) -> "Schedule":
        """Passes in order of time; a clock shows milliseconds."""
        points = [len(p.frequency_hz) for p in passes]
        return cls(
            frequency_hz=np.concatenate([p.frequency_hz for p in passes]),
            segment=np.repeat([np.intp(p.segment) for p in passes], points),
            sweep=np.repeat(np.arange(1, len(passes) + 1, dtype=np.intp), points),
            level_g=np.repeat([p.level_g for p in passes], points),
            time_s=np.concatenate([np.round(p.time_s, 3) for p in passes]),
        )

    @property
    def middles_hz(self) -> tuple[float, ...]:
        """Middle frequencies of the segments, ascending."""
        f, k = self.frequency_hz, self.segment
        return tuple(sorted(float((f[k == n].min() + f[k == n].max()) / 2) for n in np.unique(k)))

    def read(self, velocity_m_s: Complex, commanded_m_s2: Array, base_m_s2: Complex) -> Sweep:
        """The sweep as the rig would record it. Shape (points,) each."""
        return Sweep(
            frequency_hz=self.frequency_hz,
            velocity_m_s=velocity_m_s,
            commanded_m_s2=commanded_m_s2,
            segment=self.segment,
            sweep=self.sweep,
            base_m_s2=base_m_s2,
            time_s=self.time_s,
        )


def draw_levels(rng: np.random.Generator, effects: Sequence[str]) -> tuple[float, ...]:
    """Levels in g of a sweep that hides these: mostly one."""
    alone = min((_ONE_LEVEL_SHARE.get(name, _ONE_LEVEL_ELSE) for name in effects), default=_ONE_LEVEL_ELSE)
    return (1.0,) if rng.random() < alone else THREE_LEVELS_G


def between_s(rng: np.random.Generator) -> float:
    """From one pass to the next."""
    return float(rng.uniform(*_BETWEEN_S))
