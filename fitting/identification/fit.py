"""What both methods return before anything is said about it: a law and how it was reached."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.identification.adjusted import Adjusted
from fitting.laws import CoreLaw


@dataclass(frozen=True)
class Fit:
    """The end of a fit.

    `residuals` and `jacobian` are whitened: derivatives to the log parameters of the law, then to the stated
    numbers that the fit may move. Shapes (data,) and (data, parameters).
    """

    law: CoreLaw
    residuals: Array
    jacobian: Array
    velocity_m_s: NDArray[np.complex128]
    """Predicted at the sweep's points."""
    iterations: int
    evaluations: int
    converged: bool
    readings: int | None = None
    """How many of `residuals` are readings of the sweep; None for all."""
    covariance: Array | None = None
    """Of the law's log parameters, everything else marginalised; None to take it from `jacobian`."""
    posterior: Array | None = None
    """The same beside the stated numbers', in standard deviations of their tolerances."""
    adjusted: tuple[Adjusted, ...] = ()
    """The stated numbers as the fit has them."""
    weights: Array | None = None
    """What `residuals` and `jacobian` were multiplied by beyond the noise; None for nothing."""
    criterion_met: bool | None = None
    """The paper's 5 % criterion, where its method was asked for."""
