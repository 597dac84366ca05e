"""Identification by bounded least squares in the log parameters, from a global start."""

import numpy as np
from scipy.optimize import OptimizeResult, least_squares

from fitting.arrays import Array
from fitting.errors import TooFewPoints
from fitting.identification.fit import Fit
from fitting.identification.residuals import Residuals
from fitting.laws import CoreLaw

CANDIDATES = 64
"""Laws looked at before the first step."""
STARTS = 2
"""Of those, how many are followed, beside the start given."""
_LOOK_AT = 24
"""Points that starts are compared on, evenly through the sweep: enough to tell one from another."""
_MOST_EVALUATIONS = 200
"""A bound on time; what has not come to its end by then says `converged = False`."""
_STEP_AT_REST, _GAIN_AT_REST = 1e-9, 1e-12
"""Relative change of the parameters and of the sum of squares at which the fit has come to its end."""
_ROUGH, _ROUGH_EVALUATIONS = 1e-4, 8
"""The same of both in a descent from a start that was only looked at, and a bound on its time. A choice."""
_WORTH_FOLLOWING = 1e-3
"""Relative gain over the best so far from which such a valley is followed to its end. A choice."""
_ROUNDS = 60
"""Of the fixed point of `_spread`: each takes off two thirds of the error or more, to the last digit."""


def fit_direct(residuals: Residuals, start: CoreLaw) -> Fit:
    """Minimise the sum of squares of `residuals` over the parameters of `start`, within their limits.

    Raises `TooFewPoints` for a law without parameters or a single point.
    """
    check_determined(residuals, start)
    start = start.lifted()
    runs = [_minimise(residuals, start)]
    for candidate in _candidates(residuals, start):
        # Far from the start a rough descent decides whether this valley is worth following.
        runs.append(_minimise(residuals, candidate, rough=True))
        if runs[-1].cost < min(run.cost for run in runs[:-1]) * (1 - _WORTH_FOLLOWING):
            runs.append(_minimise(residuals, start.with_logs(runs[-1].x)))
    best = min(runs, key=lambda run: float(run.cost))
    law = start.with_logs(best.x)
    r, J = residuals.with_jacobian(law)
    return Fit(
        law=law,
        residuals=r,
        jacobian=J,
        velocity_m_s=residuals.model.velocity(law),
        iterations=int(best.njev),
        evaluations=sum(int(run.nfev) for run in runs) + CANDIDATES,
        converged=bool(best.status > 0),
        weights=residuals.weights,
    )


def refit(residuals: Residuals, start: CoreLaw) -> CoreLaw:
    """The law that fits from `start` alone, no other start tried."""
    return start.with_logs(_minimise(residuals, start).x)


def check_determined(residuals: Residuals, law: CoreLaw) -> None:
    """Refuse what no fit can answer."""
    if not law.names:
        raise TooFewPoints(f"core law {law.kind} has no parameter to identify, choose another law")
    if len(residuals.sigma_m_s) < 2:
        raise TooFewPoints(
            f"1 point cannot carry the {len(law.names)} parameters of {law.kind}, expected more than that"
        )


def _minimise(residuals: Residuals, start: CoreLaw, *, rough: bool = False) -> OptimizeResult:
    lower, upper = start.log_limits
    last: dict[bytes, tuple[Array, Array]] = {}

    def both(logs: Array) -> tuple[Array, Array]:
        key = logs.tobytes()
        if key not in last:
            last.clear()
            last[key] = residuals.with_jacobian(start.with_logs(logs))
        return last[key]

    return least_squares(
        lambda p: both(p)[0],
        np.clip(np.log(start.values), lower, upper),
        jac=lambda p: both(p)[1],
        bounds=(lower, upper),
        x_scale="jac",
        xtol=_ROUGH if rough else _STEP_AT_REST,
        ftol=_ROUGH if rough else _GAIN_AT_REST,
        max_nfev=_ROUGH_EVALUATIONS if rough else _MOST_EVALUATIONS,
    )


def _candidates(residuals: Residuals, law: CoreLaw) -> list[CoreLaw]:
    """The best of a low-discrepancy set over the law's search ranges, judged by amplitude at a few points."""
    low, high = np.log([q.search for q in law.limits]).T
    few = residuals.take(np.unique(np.linspace(0, len(residuals.sigma_m_s) - 1, _LOOK_AT).astype(np.intp)))
    laws = [law.with_logs(low + u * (high - low)) for u in _spread(len(low), CANDIDATES)]
    omega = few.model.rational.omega
    many = few.model.rational.displacement(np.array([one.modulus(omega) for one in laws]))
    size = np.abs(few.model.velocities(many))
    misfit = np.abs(np.log(size / np.abs(few.readings.measured_m_s))).mean(axis=1)
    return [laws[k] for k in np.argsort(misfit)[:STARTS]]


def _spread(dimensions: int, count: int) -> Array:
    """Points of Roberts' R-sequence in the unit cube. Shape (count, dimensions)."""
    g = 1.5
    for _ in range(_ROUNDS):
        g = (1 + g) ** (1 / (dimensions + 1))
    steps = g ** -np.arange(1, dimensions + 1)
    return np.asarray((0.5 + np.outer(np.arange(1, count + 1), steps)) % 1)
