"""Which steps to take: greedily, what brings the worst of the band down fastest for its rig time.

c-optimal for all aims at once: the sum of (variance / target^2)^p over G' and eta along the band, p large
enough that the worst one rules. A candidate is taken once at most: part of the model's error is white
over frequency, and would be averaged away by repeats though it is the same every time.
"""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Integers
from fitting.planning.aims import Aims
from fitting.planning.sensitivity import Sensitivity

_POWER = 4
"""Of the variances in the sum that a step is chosen by: high enough for the worst to count most. A choice."""
NEAR_LIMIT = 1.1
"""Times what all candidates together would leave: where the target is beyond that, a plan ends here."""


@dataclass(frozen=True)
class Choice:
    """Steps in the order they were chosen."""

    taken: Integers
    """Candidates. Shape (steps,)."""
    worst: Array
    """Largest relative standard error after each of them; the first entry before any. Shape (steps + 1,)."""
    seconds: Array
    """Rig time used by then. Shape (steps + 1,)."""
    limit: float
    """Largest relative standard error that all candidates together would leave."""
    reachable: bool
    """Whether the target is not below that limit."""
    reached: bool
    """Whether the target is met by these steps."""


def limit_of(s: Sensitivity, aims: Aims) -> float:
    """What all candidates together would leave of the worst relative standard error."""
    return float(aims.errors(s.covariance(np.ones(len(s.rows)))).max())


def choose(
    s: Sensitivity,
    aims: Aims,
    seconds: Array,
    target: float,
    *,
    taken: Array | None = None,
    budget_s: float = np.inf,
    most: int | None = None,
) -> Choice:
    """Steps until the worst relative standard error is at most `target`, or the limit is near.

    `taken` counts the readings there are at each candidate; `most` limits the steps. Shapes (candidates,).
    """
    count = np.zeros(len(s.rows)) if taken is None else np.asarray(taken, dtype=float).copy()
    limit = limit_of(s, aims)
    reachable = limit <= target
    goal = target if reachable else NEAR_LIMIT * limit
    C = s.covariance(count)
    order: list[int] = []
    worst, used = [float(aims.errors(C).max())], [0.0]
    while worst[-1] > goal and (most is None or len(order) < most):
        gain = gains(s, aims, C, goal) / seconds
        gain[(count > 0) | (used[-1] + seconds > budget_s)] = -np.inf
        best = int(np.argmax(gain))
        if not np.isfinite(gain[best]):
            break
        C = with_reading(C, s.rows[best])
        count[best] += 1
        order.append(best)
        worst.append(float(aims.errors(C).max()))
        used.append(used[-1] + float(seconds[best]))
    return Choice(
        np.array(order, dtype=np.intp),
        np.array(worst),
        np.array(used),
        limit,
        reachable,
        worst[-1] <= target,
    )


def gains(s: Sensitivity, aims: Aims, covariance: Array, goal: float) -> Array:
    """By how much each candidate would lower the logarithm of the criterion. Shape (candidates,)."""
    n = aims.gradient.shape[2]
    c = aims.gradient.reshape(-1, n)
    variance = np.einsum("ki,ij,kj->k", c, covariance[:n, :n], c)
    CA = s.rows @ covariance
    S = CA @ s.rows.transpose(0, 2, 1) + np.eye(2)
    along = CA[:, :, :n] @ c.T
    # (candidates, 2, aims): what one phasor takes off each variance is along^T S^-1 along.
    less = np.einsum("nak,nak->nk", along, np.linalg.solve(S, along))
    left = np.maximum(variance - less, 0.0)
    before = np.sum((variance / goal**2) ** _POWER)
    after = np.sum((left / goal**2) ** _POWER, axis=1)
    return np.asarray(np.log(before) - np.log(np.maximum(after, np.finfo(float).tiny)))


def with_reading(covariance: Array, rows: Array) -> Array:
    """The covariance with one more phasor, its two rows of shape (2, unknowns)."""
    CA = covariance @ rows.T
    S = rows @ CA + np.eye(2)
    found = covariance - CA @ np.linalg.solve(S, CA.T)
    return np.asarray((found + found.T) / 2)
