"""The response of a law that was found, anywhere in frequency, and how well the fit knows it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.specimen import Specimen
from instrument.files.fit_file import FoundLaw
from instrument.models import Models
from instrument.progress import Progress, quiet

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_STEP = 1e-4
"""Relative step in G* by which the response's derivative is taken; it is analytic in G*."""


@dataclass(frozen=True)
class FittedResponse:
    """Velocity at the pickup under the specimen's base acceleration. Shape (points,) each."""

    frequency_hz: Array
    velocity_m_s: Complex
    amplitude_standard_error_m_s: Array
    """By the noise of the points fitted; NaN where the fit knows none."""
    phase_standard_error_rad: Array


def fitted_response(
    specimen: Specimen, found: FoundLaw, frequency_hz: Array, progress: Progress = quiet
) -> FittedResponse:
    """Predict with the law found; its covariance is carried over to first order.

    Raises `BadInput` for a law of another kind, `OutsideModel` for a bare plate.
    """
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core, expected [core] and [constraining]")
    law = found.law(specimen.core.law)
    models = Models.of(specimen, frequency_hz, progress)
    if models.uncertified(law, frequency_hz):
        # As the identification does: its models are in the cache.
        models = replace(models, domain=models.domain.widened(law, frequency_hz))
    v = models.predict(law, frequency_hz)
    ratio = _derivatives(models, law, frequency_hz) / v
    covariance = found.covariance(law.names)
    return FittedResponse(
        frequency_hz,
        v,
        np.abs(v) * _propagated(covariance, ratio.real),
        _propagated(covariance, ratio.imag),
    )


def _derivatives(models: Models, law: CoreLaw, frequency_hz: Array) -> Complex:
    """dv/d log p at each frequency. Shape (parameters, points)."""
    omega = 2 * np.pi * frequency_hz
    G = law.modulus(omega)
    above, below = (models.reduced.displacement(omega, (1 + s) * G) for s in (_STEP, -_STEP))
    dv_dG = 1j * omega * (above - below) / (2 * _STEP * G) * models.specimen.base_acceleration_m_s2
    return np.asarray(dv_dG * law.jacobian(omega) * law.values[:, None])


def _propagated(covariance: Array, gradient: Array) -> Array:
    return np.sqrt(np.maximum(np.einsum("if,ij,jf->f", gradient, covariance, gradient), 0))
