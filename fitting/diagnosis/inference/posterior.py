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


def posterior(response: Response, evidence: Evidence, fitted: Refitted) -> Array:
    """`Refitted.covariance`, wider where chi-square is flatter than its curvature says. Shape as there.

    Looked at along the directions of the stated numbers that the fit has moved by more than a standard
    deviation: one posterior standard deviation off, chi-square must have risen by one.
    """
    C = fitted.covariance
    moved = np.flatnonzero(np.abs(fitted.z) > 1)
    if not len(moved) or not fitted.noise_known:
        return C
    problem = JointProblem(response, evidence, fitted.law, fitted.u, None)
    x, (lower, upper) = problem.start, problem.limits
    n = len(fitted.law.names)
    for k in n + moved:
        step = C[:, k] / np.sqrt(C[k, k])
        rises = [_chi2(problem, np.clip(x + s * step, lower, upper)) - fitted.chi2 for s in (1, -1)]
        rise = float(np.clip(np.mean(rises), 1 / _WIDEST**2, None))
        if rise < 1:
            C = C + (1 / rise - 1) * np.outer(step, step)
    return C


def _chi2(problem: JointProblem, x: Array) -> float:
    """At a place; infinite where the structure has no such modes, or less than no mass."""
    try:
        return float(np.sum(problem.residuals(x) ** 2))
    except (OutsideModel, np.linalg.LinAlgError):
        return np.inf
