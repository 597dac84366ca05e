"""What the noise does not cover: the model's own error and the specimen's tolerances.

Each is a nuisance of known size that would move the whole response a little. First order: a nuisance
that shifts the residuals by B moves the log parameters by -J^+ B.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.identification.residuals import Residuals
from fitting.laws import CoreLaw
from fitting.properties import PROPERTIES
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

FREQUENCY_ERROR = 5e-4
"""Standard deviation of the layer-wise plate's resonances against a 3D solid, each region by itself."""
GAIN_ERROR = 2e-3
"""The same for its response, in size and in phase."""


@dataclass(frozen=True)
class Systematic:
    """Shifts of the whitened residuals, one column a nuisance of one standard deviation."""

    B: Array
    """Shape (data, nuisances)."""


def systematic_of(
    residuals: Residuals, segment: NDArray[np.intp], plate: ReducedPlate, specimen: Specimen, law: CoreLaw
) -> Systematic:
    """Model error segment by segment, tolerances over all of them."""
    model = residuals.model
    omega = model.rational.omega
    dx_frequency, dx_properties = plate.derivatives(omega, law.modulus(omega))

    def at_points(dx: Complex) -> Complex:
        return (1j * omega * dx)[..., model.index] * model.acceleration_m_s2

    v = model.velocity(law)
    shifts = []
    for number in np.unique(segment):
        inside = segment == number
        shifts.append(FREQUENCY_ERROR * at_points(dx_frequency) * inside)
        shifts.append(GAIN_ERROR * v * inside)
        if residuals.has_phase:
            shifts.append(1j * GAIN_ERROR * v * inside)
    for name, size in specimen.tolerances.items():
        shifts.append(size * at_points(dx_properties[PROPERTIES.index(name)]))
    return Systematic(residuals.whiten(v, np.array(shifts)).T)
