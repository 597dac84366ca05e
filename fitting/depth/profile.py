"""Profile likelihood: chi-square along one quantity, everything else at its best for each value of it.

An interval holds the values at which chi-square rises by less than the quantile of its distribution with one
degree of freedom (Venzon and Moolgavkar, Applied Statistics 37, 1988). A quantity is held by a stiff row.
"""

from collections.abc import Iterable

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import least_squares

from fitting.arrays import Array
from fitting.depth.intervals import LEVELS, Intervals
from fitting.depth.quantities import Quantities
from fitting.errors import OutsideModel
from fitting.progress import Report

_STIFF = 300.0
"""Times the quantity's own standard error, by which a value is held."""
_LOOKS = (1.0, 2.1)
"""Linear standard errors at which it is looked."""
_FURTHER = 3
"""Looks more, where chi-square has not risen far enough."""
_STRETCH = 3.0
"""Times that a look goes further or less far than the linear error says; a choice against wild jumps."""
_BY_VALUE = 1.0
"""Error of a logarithm, from which a quantity goes by factors: it rests on what is next to nothing."""
_MOST_EVALUATIONS = 40
"""A bound on time: a fit starts at most a few standard errors beside its end."""


def profile(
    quantities: Quantities, report: Report = lambda share: None, only: Iterable[int] | None = None
) -> Intervals:
    """Both intervals of every quantity, or of `only` some; NaN for the others."""
    count = len(quantities.names)
    wanted = sorted(k % count for k in (range(count) if only is None else only))
    bounds = {level: np.full((count, 2), np.nan) for level in LEVELS}
    for k in wanted:
        for side in (0, 1):
            q, s = _along(quantities, k, (-1, 1)[side])
            # A look that has risen no further than one before it says nothing of the way between them.
            rising = np.concatenate([[True], s[1:] > np.maximum.accumulate(s)[:-1]])
            if rising.sum() < 2:
                continue
            curve = PchipInterpolator(s[rising], q[rising])
            for level, z in LEVELS.items():
                if z <= s[rising][-1]:
                    bounds[level][k, side] = curve(z)
        report((k + 1) / count)
    return Intervals.of_logs("profile", quantities, bounds)


def _along(quantities: Quantities, k: int, sign: int) -> tuple[Array, Array]:
    """Values of one quantity on one side, and the root of what chi-square rises there."""
    task = quantities.task
    x, q_0 = task.mode, quantities.logs(task.mode)[k]
    slope = quantities.gradient(x)[k]
    error = float(np.linalg.norm(slope @ task.root))
    step = task.covariance @ slope / max(error, 1e-300) ** 2
    least = float(np.sum(task.residuals(x) ** 2))
    found, rises = [q_0], [0.0]
    if not error > 0:
        return np.array(found), np.array(rises)
    stretch, by_value = 1.0, error > _BY_VALUE
    looks = list(_LOOKS)
    while looks and len(found) < len(_LOOKS) + _FURTHER + 1:
        further = looks.pop(0) * stretch * error
        to = q_0 + sign * (float(np.log1p(further)) if by_value else further)
        before = quantities.logs(x)[k]
        off = np.exp(abs(to - q_0)) - np.exp(abs(before - q_0)) if by_value else sign * (to - before)
        try:
            x = _held(quantities, k, to, x + sign * off * step, min(error, _BY_VALUE))
        except OutsideModel:
            # No specimen has such modes: what is told ends here.
            break
        rise = np.sqrt(max(float(np.sum(task.residuals(x) ** 2)) - least, 0.0))
        q = float(quantities.logs(x)[k])
        found.append(q)
        rises.append(rise)
        linear = abs(np.expm1(abs(q - q_0)) if by_value else q - q_0) / error
        stretch = float(np.clip(linear / max(rise, 1e-3), 1 / _STRETCH, _STRETCH))
        if not looks and rise < LEVELS[95]:
            looks = [2.2]
    return np.array(found), np.array(rises)


def _held(quantities: Quantities, k: int, to: float, start: Array, error: float) -> Array:
    """The best unknowns where a quantity has a value."""
    task, stiff = quantities.task, _STIFF / error
    low, high = task.limits

    def residuals(x: Array) -> Array:
        return np.append(task.residuals(x), stiff * (quantities.logs(x)[k] - to))

    def jacobian(x: Array) -> Array:
        return np.vstack([task.jacobian(x), stiff * quantities.gradient(x)[k]])

    inside = np.clip(start, low, high)
    return least_squares(
        residuals,
        inside,
        jac=jacobian,
        bounds=(low, high),
        x_scale="jac",
        ftol=1e-6,
        xtol=1e-7,
        max_nfev=_MOST_EVALUATIONS,
    ).x
