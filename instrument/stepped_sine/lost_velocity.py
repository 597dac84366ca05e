"""A velocity that is none: an input that does not change, or points that are within its own noise.

One point within its noise is what an anti-resonance may leave; a tenth of the band is not.
"""

from collections.abc import Iterable, Sequence
from itertools import takewhile

import numpy as np

from fitting.arrays import Array
from instrument.stream.derived import LimitExceeded, PointMeasured

_STILL_BLOCKS = 3
"""So many in a row, until an input that does not change counts as dead, as of a lost base. A choice."""
_WITHIN = 3.0
"""Standard deviations of each part: noise alone is beyond in one reading of a hundred."""
_WORDS = "velocity within its noise"
"""What the remark on such a point begins with, by which it is known afterwards."""
_MOST_POINTS = 5
"""So many in a row within their noise ..."""
_BAND = 1.1
"""... over a band whose ends are so far apart as a ratio, until the velocity counts as lost: a dip as deep as
an anti-resonance's is narrower. Choices."""
_REMEDY = "is the beam on the spot, the cable on, the vibrometer's output on this input?"


class StillVelocity:
    """Counts the readings of a step in which the velocity's input does not change at all."""

    def __init__(self) -> None:
        self._blocks = 0

    def add(self, velocity: Array) -> bool:
        """Take a reading, shape (samples,); whether its input stands still."""
        still = bool(np.ptp(velocity) == 0)
        self._blocks = self._blocks + 1 if still else 0
        return still

    @property
    def lost(self) -> bool:
        """Whether it has stood still long enough to be dead."""
        return self._blocks >= _STILL_BLOCKS

    def stop(self, step: int, frequency_hz: float) -> LimitExceeded:
        """The event that ends the run."""
        what = "velocity lost: readings in a row in which its input does not change"
        return LimitExceeded(
            step, what, float(self._blocks), float(_STILL_BLOCKS - 1), "", _REMEDY, frequency_hz
        )


def noise_remarks(size: float, std: float) -> list[str]:
    """What a point's velocity and its noise alone, in one unit, have to say; nothing where it stands out."""
    return [f"{_WORDS}: {size / std:.1f} standard deviations"] if size < _WITHIN * std else []


def lost_in_noise(points: Sequence[PointMeasured]) -> list[LimitExceeded]:
    """What ends the run after the last of a session's points; empty where nothing does."""
    weak = list(_weak_at_the_end(points))
    f = [p.frequency_hz for p in weak]
    if len(weak) < _MOST_POINTS or max(f) < _BAND * min(f):
        return []
    what = "velocity lost: points in a row within its own noise"
    remedy = f"{_REMEDY} if all are, raise the level or leave these frequencies out"
    last = weak[0]
    return [
        LimitExceeded(
            last.step, what, float(len(weak)), float(_MOST_POINTS - 1), "", remedy, last.frequency_hz
        )
    ]


def _weak_at_the_end(points: Sequence[PointMeasured]) -> Iterable[PointMeasured]:
    """The last one first."""
    return takewhile(lambda p: any(r.startswith(_WORDS) for r in p.remarks), reversed(points))
