"""Bootstrap: what the fit gives of data drawn anew.

    r*(x) = r(x) - r(fit) + drawn

`drawn` is noise and model error of the sizes the fit goes by (`points`: parametric), or stretches of the
fit's own whitened residuals, drawn with replacement within every segment (`segments`: Kuensch, Annals of
Statistics 17, 1989). Stated numbers and the law's bend are drawn from their priors either way.
"""

from typing import Literal

import numpy as np

from fitting.arrays import Array
from fitting.depth.intervals import Intervals, of_draws
from fitting.depth.many import ManyResiduals
from fitting.depth.quantities import Quantities

Kind = Literal["points", "segments"]
_STEPS = 8
"""By one Jacobian, from a fit that lies nearby; a choice: a step that does not help is shortened."""
_STRETCH = 5
"""Points that stay together."""


def bootstrap(
    quantities: Quantities, many: ManyResiduals, kind: Kind = "points", draws: int = 400, seed: int = 0
) -> Intervals:
    """Percentile intervals of refits."""
    rng = np.random.default_rng([seed, draws])
    task = quantities.task
    at = many(task.mode[None])[0]
    drawn = rng.standard_normal((draws, len(at)))
    if kind == "segments":
        drawn[:, : task.begun.evidence.count] = _stretches(quantities, at, draws, rng)
    X = _refitted(many, drawn - at)
    return Intervals.of_logs(f"bootstrap of {kind}", quantities, of_draws(quantities.of_many(X)))


def _refitted(many: ManyResiduals, shift: Array) -> Array:
    """The best unknowns for every row of shifted residuals, by Gauss-Newton steps of one Jacobian."""
    task = many.task
    low, high = task.limits
    J = task.jacobian(task.mode)
    step = -np.linalg.pinv(J, rcond=1e-12)
    X = np.tile(task.mode, (len(shift), 1))
    R = many(X) + shift
    chi2, share = np.sum(R**2, axis=1), np.ones(len(X))
    for _ in range(_STEPS):
        tried = np.clip(X + share[:, None] * (R @ step.T), low, high)
        R_tried = many(tried) + shift
        chi2_tried = np.sum(R_tried**2, axis=1)
        better = chi2_tried < chi2
        X[better], R[better], chi2[better] = tried[better], R_tried[better], chi2_tried[better]
        share = np.where(better, 1.0, share / 3)
    return X


def _stretches(quantities: Quantities, at: Array, draws: int, rng: np.random.Generator) -> Array:
    """Whitened residuals of the readings, drawn again. Shape (draws, readings)."""
    begun = quantities.task.begun
    sweep, count = begun.problem.sweep, begun.evidence.count
    parts = count // len(sweep)
    r = at[:count].reshape(parts, len(sweep))
    dof = max(count - begun.none.parameter_count, 1)
    found = np.empty((draws, parts, len(sweep)))
    for number in np.unique(sweep.segment):
        inside = np.flatnonzero(sweep.segment == number)
        inside = inside[np.argsort(sweep.frequency_hz[inside], kind="stable")]
        n, long = len(inside), min(_STRETCH, max(1, len(inside) // 3))
        starts = rng.integers(0, n, (draws, -(-n // long)))
        taken = ((starts[:, :, None] + np.arange(long)) % n).reshape(draws, -1)[:, :n]
        # A stretch of either sign is as likely.
        sign = rng.choice((-1.0, 1.0), (draws, starts.shape[1], 1)) * np.ones(long)
        found[:, :, inside] = r[:, inside[taken]].transpose(1, 0, 2) * sign.reshape(draws, 1, -1)[:, :, :n]
    return found.reshape(draws, count) * np.sqrt(count / dof)
