"""The sweep's points as arrays to draw: velocity over base acceleration, segment by segment."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from instrument.facts.diagnosis import DiagnosisResult
from instrument.session.contents import Contents
from instrument.stream.derived import PointMeasured


@dataclass(frozen=True)
class Measured:
    """Points of one segment, all its sweeps, ascending in frequency. Shape (points,) each."""

    segment: int
    frequency_hz: Array
    over_base: Complex
    """Velocity over base acceleration in s."""
    std: Array
    """Of each part of it, by the noise of both channels."""

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


def explained(measured: Measured, found: DiagnosisResult | None) -> tuple[Array, Complex] | None:
    """Frequencies in Hz, and velocity over base acceleration in s with the effects found: (points,) each.

    What a diagnosis predicts at its points, of one sweep at one level; None where it named nothing.
    """
    if found is None or not found.effects or found.verdict not in ("effect", "ambiguous"):
        return None
    left = {p.frequency_hz: p.after for p in reversed(found.points) if p.after.has_phase}
    at = [k for k, f in enumerate(measured.frequency_hz) if float(f) in left]
    if not at:
        return None
    f = measured.frequency_hz[at]
    once = np.concatenate([[True], np.diff(f) > 0])
    ratio = np.array([1 + 0.01 * complex(left[float(x)].re_percent, left[float(x)].im_percent) for x in f])
    return f[once], (measured.over_base[at] * ratio)[once]


def segments_of(contents: Contents) -> list[Measured]:
    """Every segment with points in it; sentinels are not among them."""
    steps = [p for p in contents.measured if p.purpose == "step"]
    return [_segment(n, steps) for n in sorted({p.segment for p in steps})]


def _segment(number: int, steps: list[PointMeasured]) -> Measured:
    mine = sorted((p for p in steps if p.segment == number), key=lambda p: float(p.frequency_hz))
    base, v = np.array([p.base_m_s2 for p in mine]), np.array([p.velocity_m_s for p in mine])
    noise = np.hypot(noise_of(mine, "velocity"), noise_of(mine, "base"))
    return Measured(number, np.array([p.frequency_hz for p in mine]), v / base, noise * np.abs(v / base))


def noise_of(points: list[PointMeasured], channel: str) -> Array:
    """Standard deviation of each part over the amplitude: a fraction. Shape (points,)."""
    if channel == "velocity":
        return np.array([p.velocity_std_m_s / abs(p.velocity_m_s) for p in points])
    return np.array([p.base_accel_std_m_s2 / abs(p.base_m_s2) for p in points])
