"""Residuals of a sweep under a law: complex and whitened, or amplitudes where there is no phase."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.identification.model import SweepModel
from fitting.laws import CoreLaw
from fitting.noise import Noise
from fitting.sweep import Sweep

Points = NDArray[np.intp] | NDArray[np.bool_]


@dataclass(frozen=True)
class Residuals:
    """(predicted - measured) / sigma; real and imaginary parts one after the other."""

    model: SweepModel
    measured_m_s: NDArray[np.complex128] | Array
    sigma_m_s: Array
    weight: Array
    """Relative, their mean square one: they choose, they do not change the noise. Shape (points,)."""

    @classmethod
    def of(cls, sweep: Sweep, noise: Noise, model: SweepModel) -> "Residuals":
        """Residuals of a sweep with its noise and the file's weights."""
        weight = np.ones(len(sweep)) if sweep.weight is None else sweep.weight
        weight = weight / np.sqrt(np.mean(weight**2))
        return cls(model, sweep.response_m_s, noise.std_m_s, weight)

    @property
    def has_phase(self) -> bool:
        """Whether the data are phasors."""
        return bool(np.iscomplexobj(self.measured_m_s))

    @property
    def weights(self) -> Array:
        """Of every residual. Shape (count,)."""
        return np.tile(self.weight, 2) if self.has_phase else self.weight

    @property
    def count(self) -> int:
        """Real data: two a phasor."""
        return len(self.measured_m_s) * (2 if self.has_phase else 1)

    def __call__(self, law: CoreLaw) -> Array:
        """Shape (count,)."""
        return self._stack(self._compare(self.model.velocity(law)))

    def with_jacobian(self, law: CoreLaw) -> tuple[Array, Array]:
        """Residuals and their derivatives to the log parameters. Shapes (count,), (count, parameters)."""
        v, dv = self.model.with_derivatives(law)
        return self._stack(self._compare(v)), self.whiten(v, dv).T

    def whiten(self, v: NDArray[np.complex128], dv: NDArray[np.complex128]) -> Array:
        """How residuals change with changes `dv` of the prediction `v`. Shape (..., count)."""
        # d|v| = Re(conj(v) dv)/|v|
        change = dv if self.has_phase else np.real(np.conj(v) * dv) / np.abs(v)
        return self._stack(change * (self.weight / self.sigma_m_s))

    def take(self, points: Points) -> "Residuals":
        """Some of the points."""
        return Residuals(
            self.model.take(points), self.measured_m_s[points], self.sigma_m_s[points], self.weight[points]
        )

    def _compare(self, v: NDArray[np.complex128]) -> NDArray[np.complex128] | Array:
        return ((v if self.has_phase else np.abs(v)) - self.measured_m_s) * (self.weight / self.sigma_m_s)

    def _stack(self, z: NDArray[np.complex128] | Array) -> Array:
        return np.concatenate([z.real, z.imag], axis=-1) if self.has_phase else np.real(z)
