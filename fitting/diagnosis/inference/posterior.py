"""The covariance of a fit, looked at once more along what the fit has moved far."""

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.joint_problem import JointProblem
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.response.response import Response
from fitting.errors import OutsideModel

_WIDEST = 3.0
"""Times a standard error, that a flat chi-square may widen it."""


def posterior(response: Response, evidence: Evidence, fitted: Refitted, temper: float = 1.0) -> Array:
    """`Refitted.tempered_covariance`, wider where chi-square is flatter than its curvature says.

    Shape as there. `temper` divides what the readings add to chi-square.

    Looked at along the directions of the stated numbers that the fit has moved by more than a standard
    deviation: one posterior standard deviation off, chi-square must have risen by one.
    """
    C = fitted.tempered_covariance(temper)
    moved = np.flatnonzero(np.abs(fitted.z) > 1)
    if not len(moved) or not fitted.noise_known:
        return C
    problem = JointProblem(response, evidence, fitted.law, fitted.u, None)
    x, (lower, upper) = problem.start, problem.limits
    n = len(fitted.law.names)

    def chi2_of(residuals: Array) -> float:
        squares = residuals**2
        squares[: fitted.data] /= temper
        return float(np.sum(squares))

    def rise_at(x: Array) -> float:
        """Infinite where the structure has no such modes, or less than no mass."""
        try:
            return chi2_of(problem.residuals(x)) - least
        except (OutsideModel, np.linalg.LinAlgError):
            return np.inf

    least = chi2_of(fitted.residuals)
    for k in n + moved:
        step = C[:, k] / np.sqrt(C[k, k])
        rises = [rise_at(np.clip(x + s * step, lower, upper)) for s in (1, -1)]
        rise = float(np.clip(np.mean(rises), 1 / _WIDEST**2, None))
        if rise < 1:
            C = C + (1 / rise - 1) * np.outer(step, step)
    return C
