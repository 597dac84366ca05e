"""The sentinel against its first time, as numbers to draw. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from gui.pages.sweep.points import Index, PointsMeasured
from instrument.stream.derived import SentinelCompared


@dataclass(frozen=True)
class Drift:
    """The first time, which is zero, and all later ones. Shape (times,) each."""

    index: Index
    """Which points."""
    frequency_hz: float
    time_s: Array
    percent: Array
    degree: Array

    @property
    def words(self) -> str:
        """In a line."""
        most = self.percent[np.argmax(np.abs(self.percent))]
        return (
            f"Sentinel at {self.frequency_hz:g} Hz, {len(self.index)} times: {self.percent[-1]:+.3f} % and "
            f"{self.degree[-1]:+.3f}\u00b0 against the first, at most {most:+.3f} %"
        )


def drifted(points: PointsMeasured, sentinels: Sequence[SentinelCompared]) -> Drift | None:
    """What the sentinels say; None before the second."""
    known = [(s, k) for s in sentinels if (k := points.of_step(s.step)) is not None]
    first = np.flatnonzero(points.sentinel)
    if not known or not first.size:
        return None
    index = np.array([first[0], *(k for _, k in known)], dtype=np.intp)
    return Drift(
        index,
        known[0][0].frequency_hz,
        points.time_s[index],
        np.array([0.0, *(s.change_percent for s, _ in known)]),
        np.array([0.0, *(s.change_degree for s, _ in known)]),
    )
