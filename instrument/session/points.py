"""From measured points to a sweep that can be identified."""

from collections.abc import Sequence

import numpy as np

from fitting.sweep import Sweep
from instrument.files.column import reading_std_m_s
from instrument.stream.derived import PointMeasured


def uncalibrated(points: list[PointMeasured]) -> list[str]:
    """A warning where points were read in a range that was not calibrated; nothing otherwise."""
    raw = sum(any("is not calibrated" in r for r in p.remarks) for p in points)
    if not raw:
        return []
    return [
        f"{raw} of {len(points)} points in a range not calibrated: the vibrometer's gain and delay "
        "are not taken off"
    ]


def sweep_of(points: list[PointMeasured], times_s: Sequence[float] | None = None) -> Sweep:
    """The points as a `Sweep`, each at its own level; `times_s` on any clock, where there is one.

    The reading's standard deviation holds the reference channel's too: both blur the response over the base.
    """
    return Sweep(
        frequency_hz=np.array([p.frequency_hz for p in points]),
        velocity_m_s=np.array([p.velocity_m_s for p in points]),
        commanded_m_s2=np.array([p.level_m_s2 for p in points]),
        segment=np.array([p.segment for p in points], dtype=np.intp),
        sweep=np.array([p.sweep for p in points], dtype=np.intp),
        base_m_s2=np.array([p.base_m_s2 for p in points]),
        std_m_s=reading_std_m_s(points),
        time_s=None if times_s is None else np.array(times_s) - min(times_s),
    )
