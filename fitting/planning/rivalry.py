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
from numpy.typing import NDArray
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
    known: int = 0
    """So many columns, the first, are unknowns that every measurement shares; the others are of this one."""

    def then(self, other: "Forecast") -> "Forecast":
        """Of this measurement and of another, taken together."""
        k, n, m = self.known, len(self.mean), len(other.mean)
        own, others = self.root[:, k:], other.root[:, k:]
        apart = np.block([[own, np.zeros((n, others.shape[1]))], [np.zeros((m, own.shape[1])), others]])
        shared = np.concatenate([self.root[:, :k], other.root[:, :k]])
        return Forecast(np.r_[self.mean, other.mean], np.hstack([shared, apart]), k)

    def of(self, rows: NDArray[np.intp]) -> "Forecast":
        """Of some of the data. Shape (any,)."""
        return Forecast(self.mean[rows], self.root[rows], self.known)


@dataclass(frozen=True)
class Outcome:
    """What a measurement would tell rivals apart by."""

    divergence: Array
    """D(i, j) in nats. Shape (rivals, rivals)."""
    information: float
    """Expected fall of the entropy of which rival is right, in nats."""
    left: float
    """Share of that entropy that is expected to be left."""
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
    drawn = _Drawn.of(forecasts, probabilities, temper, of)
    whole = drawn.member @ probabilities
    before, left = float(_entropy(whole)), drawn.left(probabilities)
    D = _divergences(forecasts, drawn.L)
    nearest = np.array([np.where(one, D, np.inf).min(axis=1) for one in drawn.member]).T
    return Outcome(
        np.maximum((drawn.member * probabilities) @ nearest / whole[:, None], 0.0) / temper,
        before * (1 - left),
        left,
        drawn.resolved(credible),
    )


def share_left(
    forecasts: Sequence[Forecast],
    probabilities: Array,
    temper: float = 1.0,
    of: Sequence[int] | None = None,
) -> float:
    """`left` of the outcome, and nothing else; arguments as its own, `probabilities` of shape (forms,)."""
    return _Drawn.of(forecasts, probabilities, temper, of).left(probabilities)


@dataclass(frozen=True)
class _Drawn:
    """Data drawn from each form in turn, and what becomes of the rivals."""

    L: list[Array]
    """1 + R^T R = L L^T of each form."""
    member: NDArray[np.bool_]
    """Whose each form is. Shape (rivals, forms)."""
    after: Array
    """Probabilities of the rivals. Shape (rivals, draws)."""
    weight: Array
    """Of each draw; they add up to one."""

    @classmethod
    def of(
        cls, forecasts: Sequence[Forecast], probabilities: Array, temper: float, of: Sequence[int] | None
    ) -> "_Drawn":
        L = [np.asarray(np.linalg.cholesky(np.eye(f.root.shape[1]) + f.root.T @ f.root)) for f in forecasts]
        draws = np.maximum(_FEWEST_DRAWS, np.round(_DRAWS * probabilities)).astype(int)
        random = np.random.default_rng(_SEED)
        n, count = len(forecasts[0].mean), len(forecasts)
        data = [
            f.mean[:, None]
            + f.root @ random.standard_normal((f.root.shape[1], k))
            + random.standard_normal((n, k))
            for f, k in zip(forecasts, draws, strict=True)
        ]
        every = np.concatenate(data, axis=1)
        fits = np.array([_log_density(every, f, one) for f, one in zip(forecasts, L, strict=True)])
        whose = np.arange(count) if of is None else np.array(of)
        member = np.arange(whose.max() + 1)[:, None] == whose
        after = member @ softmax(np.log(probabilities)[:, None] + fits / temper, axis=0)
        return cls(L, member, after, np.repeat(probabilities / draws, draws))

    def left(self, probabilities: Array) -> float:
        return float(self.weight @ _entropy(self.after) / _entropy(self.member @ probabilities))

    def resolved(self, credible: float) -> float:
        return float(self.weight @ (self.after.max(axis=0) >= credible))


def _entropy(p: Array) -> Array:
    """In nats, of probabilities along the first axis."""
    return np.asarray(-np.sum(np.where(p > 0, p * np.log(np.maximum(p, 1e-300)), 0.0), axis=0))


def _log_density(data: Array, f: Forecast, L: Array) -> Array:
    """Of N(m, 1 + R R^T) but for a constant; `data` of shape (data, draws)."""
    off = data - f.mean[:, None]
    squares = np.sum(off**2, axis=0) - np.sum(_explained(off, f, L) ** 2, axis=0)
    return np.asarray(-squares / 2 - np.log(np.diag(L)).sum())


def _explained(off: Array, f: Forecast, L: Array) -> Array:
    """B with S^-1 = 1 - B^T B, applied: the part of data that its unknowns make up for."""
    return np.asarray(la.solve_triangular(L, f.root.T @ off, lower=True))


def _divergences(forecasts: Sequence[Forecast], L: Sequence[Array]) -> Array:
    """D(i, j) of forms. Shape (forms, forms)."""
    count = len(forecasts)
    logdet = np.array([2 * np.log(np.diag(one)).sum() for one in L])
    varies = np.array([np.sum(f.root**2) for f in forecasts])
    ends = np.cumsum([f.root.shape[1] for f in forecasts])[:-1]
    roots = np.hstack([f.root for f in forecasts])
    D = np.zeros((count, count))
    for j, f in enumerate(forecasts):
        off = np.array([g.mean - f.mean for g in forecasts]).T
        squares = np.sum(off**2, axis=0) - np.sum(_explained(off, f, L[j]) ** 2, axis=0)
        by_root = np.split(np.sum(_explained(roots, f, L[j]) ** 2, axis=0), ends)
        # tr S_j^-1 S_i - n
        own = np.sum(la.solve_triangular(L[j], f.root.T, lower=True) ** 2)
        traces = varies - np.array([one.sum() for one in by_root]) - own
        D[:, j] = (traces + squares + logdet[j] - logdet) / 2
    return D
