"""The sweep's points as arrays to draw: velocity over base acceleration, by segment and spot."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex, Mask
from instrument.facts.diagnosis import DiagnosisResult, PointLeft
from instrument.facts.rows import PointSetAside
from instrument.results.set_aside import why_aside
from instrument.results.standing import none_is_likelier
from instrument.session.contents import Contents
from instrument.session.points import place_of
from instrument.stream.derived import PointMeasured


@dataclass(frozen=True)
class Which:
    """What tells one point of a session from all others, in whatever result it stands."""

    sweep: int
    level_m_s2: float
    pickup: int
    frequency_hz: float
    repeat: int
    """How often it had been measured before: a sentinel may be at the frequency of a step."""

    @classmethod
    def of(cls, points: Iterable[PointMeasured | PointLeft]) -> Iterator["Which"]:
        """Of points in the order of measuring. Segments are no part: several files number them on."""
        seen: Counter[tuple[int, float, int, float]] = Counter()
        for p in points:
            key = (p.sweep, p.level_m_s2, p.pickup or 0, p.frequency_hz)
            yield cls(*key, seen[key])
            seen[key] += 1


@dataclass(frozen=True)
class Measured:
    """Points of one segment, all its passes, ascending in frequency. Shape (points,) each."""

    segment: int
    frequency_hz: Array
    over_base: Complex
    """Velocity over base acceleration in s."""
    std: Array
    """Of each part of it, by the noise of both channels."""
    which: tuple[Which, ...]
    kept: Mask
    """Those that a fit takes."""
    elsewhere: str = ""
    """Another spot, a known mass or another clamping, in words; empty where all is as the file says."""

    @property
    def margin_hz(self) -> float:
        """Room beside the points."""
        low, high = float(self.frequency_hz[0]), float(self.frequency_hz[-1])
        return max(0.06 * (high - low), 1e-3 * high)

    @property
    def grid_hz(self) -> Array:
        """Frequencies to draw a model at: the points and what lies between them."""
        f = self.frequency_hz
        return np.unique(np.concatenate([f, np.linspace(f[0] - self.margin_hz, f[-1] + self.margin_hz, 241)]))


def explained(measured: Measured, found: DiagnosisResult | None) -> list[tuple[Array, Complex]]:
    """What a diagnosis predicts at its points with the effects found; empty where it named nothing.

    For each pass, level and spot: frequencies in Hz, velocity over base acceleration in s, (points,) each.
    """
    if found is None or not found.effects or found.verdict not in ("effect", "ambiguous"):
        return []
    if none_is_likelier(found):
        return []
    after = {w: p.after for w, p in zip(Which.of(found.points), found.points, strict=True)}
    lines: dict[tuple[int, float, int], list[tuple[float, complex]]] = {}
    for w, over_base in zip(measured.which, measured.over_base.tolist(), strict=True):
        left = after.get(w)
        if left is not None and left.has_phase:
            ratio = 1 + 0.01 * complex(left.re_percent, left.im_percent)
            lines.setdefault((w.sweep, w.level_m_s2, w.pickup), []).append(
                (w.frequency_hz, over_base * ratio)
            )
    return [(np.array([f for f, _ in line]), np.array([z for _, z in line])) for line in lines.values()]


def points_set_aside(contents: Contents, by_fit: Sequence[PointSetAside]) -> tuple[PointSetAside, ...]:
    """What a fit has left out, and what the recorded diagnosis has."""
    found = contents.diagnosis.result if contents.diagnosis is not None else None
    return (*by_fit, *(found.points_set_aside if found is not None else ()))


def segments_of(contents: Contents, aside: Sequence[PointSetAside] = ()) -> list[Measured]:
    """Every segment with points in it; sentinels are not among them.

    What was read elsewhere or clamped anew is by itself. A fit, or the recorded diagnosis, has set `aside`
    some.
    """
    kept = (why_aside(contents.measured, points_set_aside(contents, aside)) == "").tolist()
    every = zip(Which.of(contents.measured), contents.measured, kept, strict=True)
    steps = [(w, p, k) for w, p, k in every if p.purpose == "step"]
    places = sorted({_place(p) for _, p, _ in steps})
    return [_segment([(w, p, k) for w, p, k in steps if _place(p) == place]) for place in places]


def _place(p: PointMeasured) -> tuple[int, int, float, int]:
    return p.segment, p.pickup, p.mass_kg, p.mounting


def _segment(steps: list[tuple[Which, PointMeasured, bool]]) -> Measured:
    which, mine, kept = zip(*sorted(steps, key=lambda one: one[0].frequency_hz), strict=True)
    base, v = np.array([p.base_m_s2 for p in mine]), np.array([p.velocity_m_s for p in mine])
    noise = np.hypot(relative_noise(mine, "velocity"), relative_noise(mine, "base"))
    f = np.array([p.frequency_hz for p in mine])
    std = noise * np.abs(v / base)
    return Measured(mine[0].segment, f, v / base, std, which, np.array(kept), place_of(mine[0]))


def relative_noise(points: Sequence[PointMeasured], channel: str) -> Array:
    """Standard deviation of each part over the amplitude: a fraction. Shape (points,)."""
    if channel == "velocity":
        return np.array([p.velocity_std_m_s / abs(p.velocity_m_s) for p in points])
    return np.array([p.base_accel_std_m_s2 / abs(p.base_m_s2) for p in points])
