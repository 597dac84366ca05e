"""The response of a law and a plate that were found, anywhere in frequency, and how well the fit knows it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.dynamics.direct import displacement_direct
from fitting.errors import OutsideModel
from fitting.identification.model import velocity
from fitting.laws import CoreLaw
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.models.fitted_plate import FittedPlate
from instrument.models.specimen_models import CERTIFIED, Models
from instrument.progress import Progress, quiet
from instrument.results.fit_file import FoundLaw
from instrument.results.fitted_small import FittedSmall

_STEP = 1e-4
"""Relative step in G* by which the response's derivative is taken; it is analytic in G*."""


@dataclass(frozen=True)
class FittedResponse:
    """What the velocity channel reads under the specimen's base acceleration. Shape (points,) each."""

    frequency_hz: Array
    velocity_m_s: Complex
    amplitude_standard_error_m_s: Array
    """By the whole posterior where the fit has it, else by the law's parameters alone; NaN without any."""
    phase_standard_error_rad: Array


@dataclass(frozen=True)
class FittedModel:
    """A law and a plate that were found, on models of the plate as stated."""

    law: CoreLaw
    plate: FittedPlate
    models: Models
    covariance: Array
    """Of the law's log parameters, its bend, and what is moved of the plate."""

    @classmethod
    def of(
        cls, specimen: PlateSpecimen, found: FoundLaw, frequency_hz: Array, progress: Progress = quiet
    ) -> "FittedModel":
        """Over the band of some frequencies, of shape (points,).

        Raises `BadInput` for a law of another kind, `OutsideModel` for a bare plate.
        """
        if specimen.core is None:
            raise OutsideModel("a bare plate has no core, expected [core] and [constraining]")
        law, plate = found.law(specimen.core.law), found.plate(specimen)
        models = Models.of(plate.specimen, frequency_hz, progress)
        if models.uncertified(law, frequency_hz):
            # As the identification does: its models are in the cache.
            models = replace(models, domain=models.domain.widened(law, frequency_hz))
        return cls(law, plate, models, _covariance(found, law, plate))

    @cached_property
    def _reduced(self) -> ReducedPlate:
        return self.plate.reduced(self.models)

    def velocity(self, frequency_hz: Array) -> Complex:
        """What the velocity channel reads, m/s. Shape (points,)."""
        omega = 2 * np.pi * frequency_hz
        G, models = self.law.modulus(omega), self.models
        x = self._reduced.displacement(omega, G)
        doubtful = models.reduced.estimated_error(omega, G) > CERTIFIED
        if doubtful.any():
            full = replace(models, specimen=self.plate.moved_specimen())
            x[doubtful] = displacement_direct(full.plate, full.damping, omega[doubtful], G[doubtful])
        s = self.plate.specimen
        return self.plate.read(velocity(omega, x, s.reads) * s.drive_amplitude, frequency_hz)

    def response(self, frequency_hz: Array) -> FittedResponse:
        """The velocity and its errors. Shape (points,)."""
        v = self.velocity(frequency_hz)
        ratio = self._derivatives(v, frequency_hz) / v
        return FittedResponse(
            frequency_hz,
            v,
            np.abs(v) * _propagated(self.covariance, ratio.real),
            _propagated(self.covariance, ratio.imag),
        )

    def _derivatives(self, v: Complex, frequency_hz: Array) -> Complex:
        """Of the velocity, to all that `covariance` is of. Shape (parameters, points)."""
        omega, law = 2 * np.pi * frequency_hz, self.law
        G = law.modulus(omega)
        above, below = (self._reduced.displacement(omega, (1 + s) * G) for s in (_STEP, -_STEP))
        by_law = (above - below) / (2 * _STEP * G) * law.jacobian(omega) * law.values[:, None]
        dx = np.concatenate([by_law, self.plate.by_moved(self.models, omega, G)])
        a = self.plate.specimen.drive_amplitude
        dv = self.plate.read(1j * omega * dx * a, frequency_hz)
        dv[len(law.names) :] += self.plate.by_reading(v, frequency_hz)
        return dv


def fitted_response(
    specimen: AnySpecimen, found: FoundLaw, frequency_hz: Array, progress: Progress = quiet
) -> FittedResponse:
    """Predict with the law found on the plate found; their covariance is carried over to first order.

    Shape (points,). Raises `BadInput` for a law of another kind, `OutsideModel` for a bare plate.
    """
    if isinstance(specimen, PlateSpecimen):
        return FittedModel.of(specimen, found, frequency_hz, progress).response(frequency_hz)
    if specimen.core is None:
        raise OutsideModel(f"a bare {specimen.kind} has no core, expected [core]")
    small = FittedSmall.of(specimen, found)
    v = small.velocity(frequency_hz)
    ratio = small.derivatives(frequency_hz) / v
    covariance = _among(found, small.law, small.names)
    return FittedResponse(
        frequency_hz, v, np.abs(v) * _propagated(covariance, ratio.real), _propagated(covariance, ratio.imag)
    )


def _covariance(found: FoundLaw, law: CoreLaw, plate: FittedPlate) -> Array:
    """The whole posterior, else the law's alone."""
    return _among(found, law, [*law.names, *(n.name for n in plate.nuisances.each)])


def _among(found: FoundLaw, law: CoreLaw, names: Sequence[str]) -> Array:
    if found.posterior is not None:
        return found.posterior.covariance(list(names))
    own = len(law.plain.names)
    whole = np.zeros((len(names), len(names)))
    whole[:own, :own] = found.covariance(law.plain.names)
    return whole


def _propagated(covariance: Array, gradient: Array) -> Array:
    return np.sqrt(np.maximum(np.einsum("if,ij,jf->f", gradient, covariance, gradient), 0))
