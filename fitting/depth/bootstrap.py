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
from fitting.diagnosis.inference.begin import Begun

Kind = Literal["points", "segments"]
_STEPS = 40
"""A bound on time: most come to rest within six."""
_NOTHING = 1e-3
"""Of chi-square: a step that changes less is the last one. A thousandth of what an interval goes by."""
_DAMPING = (1e-6, 1e4)
"""Of a diagonal of ones: least, with which a refit begins as it lies near the fit, and most."""
_BLOCK = 50
"""Refits side by side: their Jacobians are all in memory."""
_STRETCH = 5
"""Points that stay together."""


def bootstrap(
    quantities: Quantities, many: ManyResiduals, kind: Kind = "points", draws: int = 400, seed: int = 0
) -> Intervals:
    """Percentile intervals of refits."""
    rng = np.random.default_rng([seed, draws])
    task = many.task
    at = many(task.mode[None])[0]
    drawn = rng.standard_normal((draws, len(at)))
    if kind == "segments":
        drawn[:, : task.begun.evidence.count] = _stretches(task.begun, at, draws, rng)
    X = refitted(many, drawn - at)
    return Intervals.of_logs(f"bootstrap of {kind}", quantities, of_draws(quantities.of_many(X)))


def refitted(many: ManyResiduals, shift: Array) -> Array:
    """The best unknowns for every row of shifted residuals. Shapes (draws, rows) to (draws, kept)."""
    blocks = [_settled(many, shift[k : k + _BLOCK]) for k in range(0, len(shift), _BLOCK)]
    return np.concatenate(blocks)


def _settled(many: ManyResiduals, shift: Array) -> Array:
    """Levenberg and Marquardt's steps, each draw by its own Jacobian, until none gains by another."""
    low, high = many.task.limits
    X = np.tile(many.task.mode, (len(shift), 1))
    R = many(X) + shift
    chi2, damping = np.sum(R**2, axis=1), np.full(len(X), _DAMPING[0])
    open_ = np.arange(len(X))
    for _ in range(_STEPS):
        x, r = X[open_], R[open_]
        J = many.jacobians(x)
        slope = np.einsum("drk,dr->dk", J, r)
        # What its limit stops stays there.
        held = ((x <= low) & (slope > 0)) | ((x >= high) & (slope < 0))
        slope[held] = 0.0
        H = J.transpose(0, 2, 1) @ J
        size = np.sqrt(np.maximum(np.einsum("dkk->dk", H), 1e-300))
        H = H / size[:, :, None] / size[:, None, :] * ~(held[:, :, None] | held[:, None, :])
        H += (damping[open_, None] + held)[:, :, None] * np.eye(H.shape[1])
        step = -np.linalg.solve(H, (slope / size)[:, :, None])[:, :, 0] / size
        tried = np.clip(x + step, low, high)
        R_tried = many(tried) + shift[open_]
        gain = chi2[open_] - np.sum(R_tried**2, axis=1)
        better, at = gain > 0, open_[gain > 0]
        X[at], R[at] = tried[better], R_tried[better]
        chi2[at] -= gain[better]
        damping[open_] = np.clip(damping[open_] * np.where(better, 0.1, 10.0), *_DAMPING)
        done = (np.abs(gain) < _NOTHING) | (~better & (damping[open_] >= _DAMPING[1]))
        open_ = open_[~done]
        if not len(open_):
            break
    return X


def _stretches(begun: Begun, at: Array, draws: int, rng: np.random.Generator) -> Array:
    """Whitened residuals of the readings, drawn again. Shape (draws, readings)."""
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
