"""Residuals of a sweep under a law: complex and whitened, or amplitudes where there is no phase."""

from dataclasses import dataclass

from fitting.arrays import Array, Complex, Indices, Mask
from fitting.data.noise import Noise
from fitting.data.readings import Readings
from fitting.identification.model import SweepModel
from fitting.laws import CoreLaw
from fitting.sweep import Sweep


@dataclass(frozen=True)
class Residuals:
    """(predicted - measured) / sigma; real and imaginary parts one after the other."""

    model: SweepModel
    readings: Readings
    sigma_m_s: Array
    weight: Array
    """`Sweep.relative_weight`. Shape (points,)."""

    @classmethod
    def of(cls, sweep: Sweep, noise: Noise, model: SweepModel) -> "Residuals":
        """Residuals of a sweep with its noise and the file's weights."""
        return cls(model, Readings(sweep.response_m_s), noise.std_m_s, sweep.relative_weight)

    @property
    def weights(self) -> Array:
        """Relative weight of every residual, as the sweep states it for its points. Shape (count,)."""
        return self.readings.each(self.weight)

    @property
    def count(self) -> int:
        """Real data: two a phasor."""
        return self.readings.count

    def __call__(self, law: CoreLaw) -> Array:
        """Shape (count,)."""
        return self._of(self.model.velocity(law))

    def with_jacobian(self, law: CoreLaw) -> tuple[Array, Array]:
        """Residuals and their derivatives to the log parameters. Shapes (count,), (count, parameters)."""
        v, dv = self.model.with_derivatives(law)
        return self._of(v), self.whiten(v, dv).T

    def whiten(self, v: Complex, dv: Complex) -> Array:
        """How residuals change with changes `dv` of the prediction `v`. Shape (..., count)."""
        return self.readings.data(self.readings.changes(v, dv) * (self.weight / self.sigma_m_s))

    def take(self, points: Mask | Indices) -> "Residuals":
        """Some of the points: numbers, or of shape (points,), true or false."""
        return Residuals(
            self.model.take(points), self.readings.take(points), self.sigma_m_s[points], self.weight[points]
        )

    def _of(self, v: Complex) -> Array:
        return self.readings.data(self.readings.off(v) * (self.weight / self.sigma_m_s))
