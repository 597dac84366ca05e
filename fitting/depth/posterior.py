"""The posterior sampled: independent chains of emcee, all walkers at once, over the law's parameters.

The rest is integrated out and drawn afterwards (`MarginalLaw`). Steps are preconditioned Crank-Nicolson ones
about a Gaussian (Cotter, Roberts, Stuart and White, Statistical Science 28, 2013), long and short ones in
turn. Walkers never look at each other, so that R-hat means what it says. Some samples are evaluated in full:
their weights say how far the short cut is off.
"""

from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np

from fitting.arrays import Array
from fitting.depth.chains import r_hat
from fitting.depth.intervals import Intervals, of_draws
from fitting.depth.many import ManyResiduals
from fitting.depth.marginal import MarginalLaw
from fitting.depth.quantities import Quantities
from fitting.errors import OutsideModel
from fitting.progress import Report

WALKERS = 80
"""Side by side: one call works on all of them. A choice."""
SAMPLES = 40_000
"""Of all walkers together, 500 steps each; `effective` says what they are worth."""
_BURN = 0.1
"""Of the samples kept: as many more go first, twice; the Gaussian stepped about is learnt in between."""
_WIDER = 1.25
"""Times the standard deviations: a Gaussian to step about must not be the narrower one."""
_STEPS = ((1.0, 0.3), (0.6, 0.4), (0.25, 0.3))
"""Length of a step, and its share."""
_CHECKED = 60
"""Samples whose weight is worked out in full, for the share that is given beside the posterior."""


@dataclass(frozen=True)
class Posterior:
    """What sampling gave, and whether it has seen enough."""

    intervals: Intervals
    samples: int
    seconds: float
    one_evaluation_s: float
    """Of the response in full: what a sampler without the short cut would pay a sample."""
    acceptance: float
    effective: Array
    """Effective sample sizes. Shape (quantities,)."""
    r_hat: Array
    checked: int
    """Samples evaluated in full."""
    weight_share: float
    """Effective share of their importance weights: one where the short cut is exact."""
    log_error: float
    """Standard deviation of the logarithms of these weights."""


def sample(
    quantities: Quantities,
    many: ManyResiduals,
    samples: int = SAMPLES,
    seed: int = 0,
    report: Report = lambda share: None,
) -> Posterior:
    """Draw from the posterior. Raises `OutsideModel` where emcee is not installed."""
    try:
        import emcee
    except ImportError:
        raise OutsideModel("sampling needs emcee: pip install 'viscorig[posterior]'") from None
    marginal, rng = MarginalLaw(many), np.random.default_rng(seed)
    began = perf_counter()
    sampler = _walked(emcee, quantities, marginal, max(20, -(-samples // WALKERS)), rng, report)
    chain = sampler.get_chain()
    T = chain.reshape(-1, chain.shape[2])
    # emcee has none where the law's parameters are all that is not known.
    rest = sampler.get_blobs()
    rest = np.empty((len(T), 0)) if rest is None else rest.reshape(len(T), -1)
    X, log_rest = marginal.drawn(T, rest, rng)
    draws = quantities.of_many(X)
    chains = draws.reshape(len(chain), WALKERS, -1)
    tau = emcee.autocorr.integrated_time(chains, quiet=True, tol=0)
    seconds = perf_counter() - began
    density = sampler.get_log_prob().ravel() + log_rest
    checked = rng.choice(len(X), min(_CHECKED, len(X)), replace=False)
    one, share, error = _checked(quantities, X[checked], density[checked])
    return Posterior(
        Intervals.of_logs("posterior", quantities, of_draws(draws)),
        len(X),
        seconds,
        one,
        float(np.mean(sampler.acceptance_fraction)),
        len(X) / np.maximum(tau, 1.0),
        np.array([r_hat(chains[:, :, k].T) for k in range(chains.shape[2])]),
        len(checked),
        share,
        error,
    )


def _walked(
    emcee: Any,
    quantities: Quantities,
    marginal: MarginalLaw,
    steps: int,
    rng: np.random.Generator,
    report: Report,
) -> Any:
    """The sampler after so many steps that count; in the two shorter walks before the Gaussian is learnt."""
    task, own = quantities.task, marginal.own
    low, high = (side[own] for side in task.limits)
    dimension = int(own.sum())

    def log_density(T: Array) -> Array:
        """And where the rest is best, as emcee takes it along."""
        found = np.full((len(T), 1 + len(own) - dimension), -np.inf)
        inside = np.all((low < T) & (high > T), axis=1)
        if inside.any():
            density, rest = marginal(T[inside])
            found[inside] = np.column_stack([density, rest])
        return found

    burn = max(20, int(_BURN * steps))
    mean, root = task.mode[own], _square(task.covariance[np.ix_(own, own)])
    at = mean + rng.standard_normal((WALKERS, dimension)) @ root.T
    # What starts outside its limits starts half way in.
    at = np.clip(at, 0.5 * (mean + low), 0.5 * (mean + high))
    done = 0
    for count in (burn, burn, steps):
        moves = [(emcee.moves.MHMove(_WalkerStep(mean, _WIDER * root, b)), share) for b, share in _STEPS]
        sampler = emcee.EnsembleSampler(WALKERS, dimension, log_density, moves=moves, vectorize=True)
        sampler.random_state = np.random.RandomState(int(rng.integers(2**31))).get_state()
        for _ in sampler.sample(at, iterations=count, skip_initial_state_check=True):
            done += 1
            if done % 10 == 0:
                report(done / (2 * burn + steps))
        chain = sampler.get_chain()
        at = chain[-1]
        seen = chain[len(chain) // 2 :].reshape(-1, dimension)
        mean, root = seen.mean(axis=0), _square(np.cov(seen.T).reshape(dimension, dimension))
    return sampler


@dataclass(frozen=True)
class _WalkerStep:
    """X' = m + sqrt(1 - b^2) (x - m) + b root xi, reversible for the Gaussian about m."""

    mode: Array
    root: Array
    length: float

    def __call__(self, coords: Array, random: np.random.RandomState) -> tuple[Array, Array]:
        """New places, and the logarithm of the ratio of their proposal densities."""
        off = coords - self.mode
        drawn = random.standard_normal((len(coords), self.root.shape[1])) @ self.root.T
        moved = np.sqrt(1 - self.length**2) * off + self.length * drawn
        return self.mode + moved, self._log_gaussian(off) - self._log_gaussian(moved)

    def _log_gaussian(self, off: Array) -> Array:
        return np.asarray(-0.5 * np.sum(np.linalg.solve(self.root, off.T) ** 2, axis=0))


def _square(covariance: Array) -> Array:
    """A square root, for a covariance that is next to singular too."""
    size = np.sqrt(np.diag(covariance))
    values, vectors = np.linalg.eigh(covariance / np.outer(size, size))
    return np.asarray(size[:, None] * vectors * np.sqrt(np.maximum(values, 1e-10 * values.max())))


def _checked(quantities: Quantities, X: Array, density: Array) -> tuple[float, float, float]:
    """Seconds of one evaluation in full; share and spread of the weights of some samples."""
    began = perf_counter()
    exact = np.array([-0.5 * np.sum(quantities.task.residuals(x) ** 2) for x in X])
    one = (perf_counter() - began) / len(X)
    log_w = exact - density
    w = np.exp(log_w - log_w.max())
    return one, float(w.sum() ** 2 / np.sum(w**2) / len(w)), float(np.std(log_w))
