"""What a fit leaves of every point, prepared for drawing. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from fitting.arrays import Array
from gui.pages.law.curve import together
from instrument.facts.diagnosis import DiagnosisResult, PointLeft, StageName
from instrument.facts.result import Result

Quantity = Literal["both", "real", "imaginary", "amplitude", "whitened"]
NAMES: dict[Quantity, str] = {
    "both": "real and imaginary",
    "real": "real part",
    "imaginary": "imaginary part",
    "amplitude": "amplitude",
    "whitened": "whitened",
}
TWO_STD = 2.0
_MARGIN, _LEAST_MARGIN = 0.04, 1e-3
"""Room beside the points: a share of their range, and of the frequency."""
_KEYS: dict[Quantity, tuple[tuple[str, str], ...]] = {
    "both": (("real part", "re_percent"), ("imaginary part", "im_percent")),
    "real": (("real part", "re_percent"),),
    "imaginary": (("imaginary part", "im_percent"),),
    "amplitude": (("amplitude", "amplitude_percent"),),
}
_WHITENED = ("real part", "imaginary part")


@dataclass(frozen=True)
class Series:
    """Points of one kind. Shape (points,) each."""

    name: str
    frequency_hz: Array
    values: Array


@dataclass(frozen=True)
class NoiseBand:
    """Two standard deviations of it, for points of one pass at one level. Shape (points,) each."""

    frequency_hz: Array
    height: Array


@dataclass(frozen=True)
class Panel:
    """One segment of one stage."""

    series: tuple[Series, ...]
    noise: tuple[NoiseBand, ...]
    aside_hz: tuple[float, ...] = ()
    """Of readings that are not fitted, and so have no residual."""

    @property
    def range_hz(self) -> tuple[float, float]:
        """Of all points, with room beside them."""
        f = np.concatenate([s.frequency_hz for s in self.series])
        margin = max(_MARGIN * float(np.ptp(f)), _LEAST_MARGIN * float(f.max()))
        return float(f.min()) - margin, float(f.max()) + margin

    @property
    def highest(self) -> float:
        """Of all points, either side of zero; at least what noise reaches."""
        found = [s.values for s in self.series] + [n.height for n in self.noise]
        sizes = [float(np.nanmax(np.abs(v))) for v in found if np.isfinite(v).any()]
        return max(sizes, default=1.0) or 1.0


def quantities(found: DiagnosisResult) -> tuple[Quantity, ...]:
    """What these data have: amplitudes alone have no parts."""
    has_phase = bool(found.points) and found.points[0].before.has_phase
    return ("both", "real", "imaginary", "amplitude", "whitened") if has_phase else ("amplitude", "whitened")


def segments(found: DiagnosisResult) -> tuple[int, ...]:
    """Numbers of them."""
    return tuple(sorted({p.segment for p in found.points}))


def panel(found: DiagnosisResult, segment: int, stage: StageName, quantity: Quantity) -> Panel:
    """Points ascending in frequency, no sentinel far off: it would leave no room for the others."""
    points = together([p for p in found.points if p.segment == segment])
    aside_hz = tuple(p.frequency_hz for p in found.points_set_aside if p.segment == segment)
    f = _column(points, "frequency_hz")
    left = [p.stage(stage) for p in points]
    if quantity == "whitened":
        parts = np.array([p.whitened for p in left], dtype=float).T
        names = _WHITENED if len(parts) > 1 else ("amplitude",)
        series = tuple(Series(name, f, part) for name, part in zip(names, parts, strict=True))
        return Panel(series, (NoiseBand(f, np.full(len(f), TWO_STD)),), aside_hz)
    series = tuple(Series(name, f, _column(left, key)) for name, key in _KEYS[quantity])
    return Panel(series, _noise(points), aside_hz)


def limit(found: DiagnosisResult, segment: int, stage: StageName, quantity: Quantity) -> float:
    """Height of the axis: what effects leave would be a line on the scale of what was before."""
    return panel(found, segment, stage, quantity).highest


def _noise(points: Sequence[PointLeft]) -> tuple[NoiseBand, ...]:
    """A band for each pass and level: between them the noise jumps."""
    found = []
    for alike in sorted({(p.sweep, p.level_m_s2) for p in points}):
        mine = [p for p in points if (p.sweep, p.level_m_s2) == alike]
        height = TWO_STD * _column(mine, "noise_percent")
        if np.isfinite(height).all():
            found.append(NoiseBand(_column(mine, "frequency_hz"), height))
    return tuple(found)


def _column(rows: Sequence[Result], key: str) -> Array:
    return np.array([getattr(row, key) for row in rows], dtype=float)
