"""Law and unknowns of some effects fitted together: bounded least squares on whitened residuals."""

from dataclasses import replace

import numpy as np
from scipy.optimize import least_squares

from fitting.arrays import Array, Mask
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.joint_problem import JointProblem
from fitting.diagnosis.inference.pace import Steps
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.response.response import Response
from fitting.laws import CoreLaw

_MOST_EVALUATIONS = 25
"""To compare; what has not come to its end by then says `converged = False`. A bound on time."""
_CONVERGED_EVALUATIONS = 150
"""To report: a valley that winds (a law against a drift) takes 75. A bound on time."""
_ROUGH_EVALUATIONS = 10
"""To choose between starts. A choice: what a good one gains it gains soon."""
_BRIEF_EVALUATIONS = 3
"""Where little is to be gained: a look whether that is so."""
ROUGH, COMPARABLE, CONVERGED = 1e-3, 1e-5, 1e-8
"""Relative change of chi-square and parameters at which a fit stops: to choose, to compare, and to report."""


_FLAT = 1e-10
"""Slope of chi-square at which a fit stops whatever it was asked for."""


def refit(
    response: Response,
    evidence: Evidence,
    law: CoreLaw,
    u: Array,
    *,
    tolerance: float = COMPARABLE,
    points: Mask | None = None,
    brief: bool = False,
    goal: float = np.inf,
    rival: float = np.inf,
    least: float = 0.0,
) -> Refitted:
    """The best law and unknowns from `law` and `u` on; `points` limits the sweep's points that count.

    Shapes: `u` as in `Refitted`, `points` (points,). `brief` where little is to be gained. Ends early where
    a chi-square of `goal` is out of reach (`Refitted.may_reach`), or one of `rival` by its last evaluation;
    and where less than `least` of it is left to gain, at the pace of its steps: then it has come to its end.
    """
    problem = JointProblem(response, evidence, law, u, points)
    lower, upper = problem.limits
    most = _BRIEF_EVALUATIONS if brief else _most(tolerance)
    steps = Steps(goal, rival, most, least)
    found = least_squares(
        problem.shortened,
        np.clip(problem.start, lower, upper),
        jac=problem.condensed,
        bounds=(lower, upper),
        x_scale="jac",
        xtol=tolerance,
        ftol=tolerance,
        gtol=_FLAT,
        max_nfev=most,
        callback=steps,
    )
    return replace(
        problem.fitted(found.x),
        iterations=int(found.njev),
        evaluations=int(found.nfev),
        converged=bool(found.status > 0) or steps.converged,
        pace=steps.pace,
    )


def _most(tolerance: float) -> int:
    if tolerance >= ROUGH:
        return _ROUGH_EVALUATIONS
    return _MOST_EVALUATIONS if tolerance >= COMPARABLE else _CONVERGED_EVALUATIONS


def evaluated(response: Response, evidence: Evidence, law: CoreLaw, u: Array) -> Refitted:
    """The fit as it is at `law` and `u`, nothing moved. Shape of `u` as in `Refitted`."""
    problem = JointProblem(response, evidence, law, u, None)
    lower, upper = problem.limits
    return problem.fitted(np.clip(problem.start, lower, upper))
