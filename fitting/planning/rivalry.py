"""How far apart rival explanations predict a measurement that has not been made.

Each rival i expects data y ~ N(m_i, S_i), where S_i holds what it has not fixed itself (its own posterior),
the noise, and what a new measurement does not know (a spot's place, a gain). The expected log Bayes factor
of i over j, were i true, is Kullback's divergence

    D(i, j) = 1/2 [tr(S_j^-1 S_i) - n + (m_i - m_j)^T S_j^-1 (m_i - m_j) + ln det S_j / det S_i]

What becomes of the probabilities is found by drawing data from each rival in turn: Lindley, Ann. Math. Stat.
27 (1956); Box and Hill, Technometrics 9 (1967).

A rival may have several forms, of which nobody knows which it takes: it is as far from another as its nearest
form is, and as probable as all of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg as la
from scipy.special import softmax

from fitting.arrays import Array

_DRAWS = 400
"""Of all rivals together: a chance of one half is then known to 2.5 %."""
_SEED = 18
"""The same data give the same ranking."""
_FEWEST_DRAWS = 20
"""Of one rival, however improbable."""


@dataclass(frozen=True)
class Forecast:
    """What one rival expects of a measurement, in standard deviations of its noise."""

    mean: Array
    """Shape (data,)."""
    root: Array
    """S = 1 + R R^T. Shape (data, any)."""


@dataclass(frozen=True)
class Outcome:
    """What a measurement would tell rivals apart by."""

    divergence: Array
    """D(i, j) in nats. Shape (rivals, rivals)."""
    information: float
    """Expected fall of the entropy of which rival is right, in nats."""
    resolved: float
    """Chance that one rival holds `credible` afterwards."""

    def between(self, i: int, j: int) -> float:
        """Expected log Bayes factor of whichever of two is true, in nats."""
        return float(self.divergence[i, j] + self.divergence[j, i]) / 2


def outcome(
    forecasts: Sequence[Forecast],
    probabilities: Array,
    temper: float = 1.0,
    credible: float = 0.95,
    of: Sequence[int] | None = None,
) -> Outcome:
    """Of one measurement, a forecast a form. `probabilities` of shape (forms,) add up to one.

    `temper`: how much less than it says a difference of likelihoods is worth. `of`: whose form each is, from
    0; a form a rival where nothing is said.
    """
    L = [np.linalg.cholesky(np.eye(len(f.mean)) + f.root @ f.root.T) for f in forecasts]
    logdet = np.array([2 * np.log(np.diag(one)).sum() for one in L])
    count = len(forecasts)
    D = np.zeros((count, count))
    # Each S_j^-1/2 once, on everything that is asked of it.
    draws = np.maximum(_FEWEST_DRAWS, np.round(_DRAWS * probabilities)).astype(int)
    random = np.random.default_rng(_SEED)
    n = len(forecasts[0].mean)
    data = np.concatenate(
        [
            f.mean[:, None] + one @ random.standard_normal((n, k))
            for f, one, k in zip(forecasts, L, draws, strict=True)
        ],
        axis=1,
    )
    fits = np.zeros((count, data.shape[1]))
    for j, f in enumerate(forecasts):
        off = np.array([g.mean - f.mean for g in forecasts]).T
        solved = la.solve_triangular(L[j], np.hstack([off, *L, data - f.mean[:, None]]), lower=True)
        squares = np.sum(solved**2, axis=0)
        traces = squares[count : count + count * n].reshape(count, n).sum(axis=1)
        D[:, j] = (traces - n + squares[:count] + logdet[j] - logdet) / 2
        fits[j] = -(squares[count + count * n :] + logdet[j]) / 2
    logs = np.log(probabilities)[:, None] + fits / temper
    whose = np.arange(count) if of is None else np.array(of)
    member = np.arange(whose.max() + 1)[:, None] == whose
    after = member @ softmax(logs, axis=0)
    entropy = -np.sum(np.where(after > 0, after * np.log(np.maximum(after, 1e-300)), 0.0), axis=0)
    which = np.repeat(np.arange(count), draws)
    weight = (probabilities / draws)[which]
    whole = member @ probabilities
    before = float(-np.sum(whole * np.log(whole)))
    nearest = np.array([np.where(one, D, np.inf).min(axis=1) for one in member]).T
    return Outcome(
        np.maximum((member * probabilities) @ nearest / whole[:, None], 0.0) / temper,
        before - float(weight @ entropy),
        float(weight @ (after.max(axis=0) >= credible)),
    )
