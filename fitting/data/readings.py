"""What was read of each point, phasors or amplitudes, beside predictions, which are phasors always."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex, Indices, Mask


@dataclass(frozen=True)
class Readings:
    """Of a sweep: two real data a phasor, one an amplitude."""

    measured_m_s: Complex | Array
    """Shape (points,)."""

    @property
    def has_phase(self) -> bool:
        """Whether they are phasors."""
        return bool(np.iscomplexobj(self.measured_m_s))

    @property
    def count(self) -> int:
        """Real numbers measured."""
        return len(self.measured_m_s) * (2 if self.has_phase else 1)

    def off(self, v: Complex) -> Complex | Array:
        """(predicted - measured), amplitudes where those were read. Shape (..., points), as `v`."""
        return (v if self.has_phase else np.abs(v)) - self.measured_m_s

    def changes(self, v: Complex, dv: Complex) -> Complex | Array:
        """Of what is read, as predictions `v` change by `dv`. Shape (..., points), as `dv`."""
        # d|v| = Re(conj(v) dv)/|v|
        return dv if self.has_phase else np.real(np.conj(v) * dv) / np.abs(v)

    def data(self, z: Complex | Array) -> Array:
        """Of every point to of every datum, imaginary parts behind real ones.

        Shape (..., points) to (..., count).
        """
        return np.concatenate([z.real, z.imag], axis=-1) if self.has_phase else np.real(z)

    def each(self, of_points: Array) -> Array:
        """What both parts of a phasor have in common, of every datum. Shape (points,) to (count,)."""
        return np.tile(of_points, 2) if self.has_phase else of_points

    def which(self, points: Mask) -> Mask:
        """Which data are of some points. Shape (points,) to (count,)."""
        return np.tile(points, 2) if self.has_phase else points

    def take(self, points: Mask | Indices) -> "Readings":
        """Some of the points: numbers, or of shape (points,), true or false."""
        return Readings(self.measured_m_s[points])
