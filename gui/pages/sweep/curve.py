"""The fitted model as it is drawn through the points. No Qt."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Self

import numpy as np

from fitting.arrays import Array, Complex
from gui.pages.sweep.points import PointsMeasured
from instrument.check.piece import Region
from instrument.facts.prediction import PredictionResult
from instrument.session.contents import SegmentRun

STANDARD_ERRORS = 2.0
"""Half width of the band."""
_A_SEGMENT = 241
_MOST_FREQUENCIES = 2000
"""Frequencies of all segments together."""


@dataclass(frozen=True)
class CurveStretch:
    """The model over one segment. Shape (frequencies,) each."""

    segment: int
    frequency_hz: Array
    over_base_s: Complex
    amplitude_std_s: Array
    """Of |v/a|; NaN where the fit knows none."""
    phase_std_deg: Array

    def phase_deg(self, points: PointsMeasured) -> Array:
        """Without jumps, and as many whole turns as the points of its segment have."""
        phase = np.unwrap(np.degrees(np.angle(self.over_base_s)), period=360.0)
        mine = (points.segment == self.segment) & ~points.sentinel & points.read_at("")
        if not mine.any():
            return phase
        off = points.phase_deg[mine] - np.interp(points.frequency_hz[mine], self.frequency_hz, phase)
        return np.asarray(phase + 360.0 * np.round(np.median(off) / 360.0))


@dataclass(frozen=True)
class Curve:
    """Of one fit, a stretch a segment."""

    stretches: tuple[CurveStretch, ...]

    @classmethod
    def of(cls, found: PredictionResult, acceleration_m_s2: float, regions: list[Region]) -> Self:
        """From what `viscorig predict` says at the frequencies of `grid`, of the first spot."""
        begin, stretches = 0, []
        points = [p for p in found.points if not p.pickup]
        for (segment, _, _), f in zip(regions, grid(regions), strict=True):
            mine = points[begin : begin + len(f)]
            begin += len(f)
            v = np.array([complex(p.velocity_re_m_s, p.velocity_im_m_s) for p in mine], dtype=np.complex128)
            std = np.array([p.velocity_standard_error_m_s for p in mine], dtype=float)
            turn = np.array([p.phase_standard_error_rad for p in mine], dtype=float)
            a = acceleration_m_s2
            stretches.append(CurveStretch(segment, f, v / a, std / a, np.degrees(turn)))
        return cls(tuple(stretches))

    def of_segments(self, segment: int | None) -> Iterator[CurveStretch]:
        """One segment's, or all."""
        return (s for s in self.stretches if segment is None or s.segment == segment)


def regions_of(segments: dict[tuple[int, int], SegmentRun]) -> list[Region]:
    """The resonance regions begun so far, each once."""
    found: dict[int, Region] = {}
    for run in segments.values():
        low, high = found.get(run.segment, (0, run.low_hz, run.high_hz))[1:]
        found[run.segment] = run.segment, min(low, run.low_hz), max(high, run.high_hz)
    return [found[number] for number in sorted(found)]


def grid(regions: list[Region]) -> list[Array]:
    """Frequencies to draw at, for each region. Shape (count,) each."""
    count = max(3, min(_A_SEGMENT, _MOST_FREQUENCIES // max(1, len(regions))))
    return [np.linspace(low, high, count) for _, low, high in regions]


def joined(stretches: list[Array]) -> Array:
    """One array with a gap between one stretch and the next. Shape (n,), as of each stretch."""
    gap = np.array([np.nan])
    return np.concatenate([part for s in stretches for part in (s, gap)][:-1]) if stretches else np.zeros(0)
