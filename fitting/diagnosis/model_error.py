"""What a layer-wise plate gets wrong against a solid, as changes of the response of known size.

Every segment's resonances a little off, its gain and its phase: sizes as in `identification.systematic`.
"""

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.refit import Fitted
from fitting.diagnosis.task import Task
from fitting.identification.systematic import FREQUENCY_ERROR, GAIN_ERROR
from fitting.laws import CoreLaw
from fitting.reduced import ReducedPlate

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def model_error(task: Task, reduced: ReducedPlate, law: CoreLaw, v: Complex) -> Complex:
    """Changes of the velocity `v`, one standard deviation each. Shape (nuisances, points)."""
    omega, index = np.unique(task.points.omega, return_inverse=True)
    dx, _ = reduced.derivatives(omega, law.modulus(omega))
    dv = (1j * omega * dx)[index.ravel()] * task.points.acceleration_m_s2
    rows = []
    for number in np.unique(task.sweep.segment):
        inside = task.sweep.segment == number
        rows += [FREQUENCY_ERROR * dv * inside, GAIN_ERROR * v * inside]
        if task.points.has_phase:
            rows.append(1j * GAIN_ERROR * v * inside)
    return np.array(rows)


def excess(evidence: Evidence, fitted: Fitted) -> float:
    """Chi-square along these changes above their number, one standard deviation each.

    What explains rightly leaves less than none: the fit has taken some of them up. What only fits, bends the
    plate by more than it is known to be wrong. In the chi-square of hundreds of points that is not seen.
    """
    along = evidence.whitening.along(fitted.residuals[: fitted.data])
    return float(along @ along) - len(along)
