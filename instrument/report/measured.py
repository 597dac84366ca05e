"""The sweep's points as arrays to draw: velocity over base acceleration, segment by segment."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
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
