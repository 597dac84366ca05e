"""What a rig does alike to every reading of several files: a transfer between base accelerometer and pads.

    ln(measured / predicted) = g(f) + o_file(f) + J x + noise

g is common to all files, o each file's own, both complex Gaussian processes of ln f of unknown size, each the
sum of a slow one and a fine one; x moves law, stated numbers and each file's own core within what is known of
them. To first order everything is normal, so the sizes are those that make the readings likeliest, and the
transfer is there where g makes them far likelier than o alone. Masses part it from the core: 1/T is then a
straight line in the mass, at every frequency by itself, and g the inverse of where the line begins.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize

from fitting.arrays import Array, Complex, Mask
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import evaluated
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.several.errors_between_files import own_cores
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.several.wandering import Wandering
from fitting.identification.validation import HeldOutSegment, Validation, rms

NATS = 10.0
"""What a transfer must gain in the logarithm of the marginal likelihood: its two sizes cost less."""
POINTS = 70
"""Of a file, evenly in ln f: nearer ones say the same again. A choice, of time."""
_TYPICAL, _SPREAD = 0.01, 2.2
"""Of a size: its median, and the standard deviation of its logarithm."""
_LEAST, _MOST = 1e-5, 0.3
"""Of a size, where a search may go: rounding, and what no channel does. A choice."""
_STEPS, _SETTLED = 6, 0.5
"""Steps of law and stated numbers at most, and the gain in nats from which on they rest. A choice."""
_STILL_NATS, _STILL = 0.05, 0.02
"""Of the logarithm of the likelihood and of a size's: where a search changes less, it ends. A choice."""
_EVALUATIONS = 250
"""A bound on time."""


@dataclass(frozen=True)
class RigTransfer:
    """A transfer that was found."""

    wandering: Wandering
    nats: float
    """Gained over files that wander each by itself."""
    ln_g: Complex
    """At every point of the problem it was asked of. Shape (points,)."""
    off: Array
    """100 (|predicted| - |measured|)/|measured|, each segment from the others. Shape (points taken,)."""
    taken: NDArray[np.intp]


@dataclass(frozen=True)
class _Linear:
    """Everything to first order about a fit, at some of the points."""

    r: Complex
    """ln(measured / predicted), the stated numbers and the bend taken back to what was stated."""
    by_x: Complex
    """Changes of ln of the reading by a standard deviation of what is known of x. Shape (x, points).

    Those of each file's own core last: `r` is as stated in them."""
    noise: Array
    t: Array
    file: NDArray[np.intp]

    def covariance(self, w: Wandering) -> Array:
        """Of the residuals, parts one after the other. Shape (2 points, 2 points)."""
        n = len(self.t)
        found = np.zeros((2 * n, 2 * n))
        found[:n, :n] = found[n:, n:] = w.covariance(self.t, self.file) + np.diag(self.noise**2)
        J = np.concatenate([self.by_x.real, self.by_x.imag], axis=1)
        return found + J.T @ J

    @property
    def data(self) -> Array:
        """Shape (2 points,)."""
        return np.concatenate([self.r.real, self.r.imag])

    def log_evidence(self, w: Wandering) -> float:
        """Up to a constant."""
        root = cho_factor(self.covariance(w), lower=True)
        y = self.data
        return float(-0.5 * y @ cho_solve(root, y) - np.log(np.diag(root[0])).sum())


def thinned(t: Array, file: NDArray[np.intp], count: int = POINTS) -> NDArray[np.intp]:
    """Of every file so many points at most, evenly in ln f. Shapes (points,)."""
    found = []
    for k in np.unique(file):
        its = np.flatnonzero(file == k)
        its = its[np.argsort(t[its], kind="stable")]
        at = np.linspace(t[its].min(), t[its].max(), count)
        found.append(np.unique(its[np.abs(t[its][:, None] - at).argmin(axis=0)]))
    return np.concatenate(found)


def rig_transfer(problem: SeveralProblem, evidence: Evidence, none: Refitted) -> RigTransfer | None:
    """What the files have in common, or None where it is not called for."""
    if not problem.sweep.has_phase:
        return None
    t = np.log(problem.sweep.frequency_hz)
    taken = thinned(t, problem.file_of_points)
    linear = _linear(problem, evidence, none, taken)
    own, _ = _likeliest(linear, common=False)
    both, best = _likeliest(linear, common=True)
    if both - own < NATS:
        return None
    linear, both, best = _settled(problem, evidence, none, taken, (linear, both, best))
    solved = np.linalg.solve(linear.covariance(best), linear.data)
    across = best.common(t, t[taken])
    n = len(taken)
    ln_g = across @ solved[:n] + 1j * (across @ solved[n:])
    off = _from_the_others(linear, best, problem.sweep.segment[taken])
    return RigTransfer(best, both - own, ln_g, off, taken)


def _settled(
    problem: SeveralProblem,
    evidence: Evidence,
    none: Refitted,
    taken: NDArray[np.intp],
    first: tuple[_Linear, float, Wandering],
) -> tuple[_Linear, float, Wandering]:
    """What is linear asked anew where it ends, the likeliest kept.

    The fit without any transfer may be far off: a first step goes too far and comes back.
    """
    likeliest = latest = first
    there = none
    for _ in range(_STEPS):
        there = _moved(problem, evidence, there, latest[0], latest[2])
        linear = _linear(problem, evidence, there, taken)
        before, latest = latest, (linear, *_likeliest(linear, common=True))
        likeliest = max(likeliest, latest, key=lambda one: one[1])
        if abs(latest[1] - before[1]) < _SETTLED:
            break
    return likeliest


def validation_of(found: RigTransfer, segment: NDArray[np.intp], noise_percent: Array) -> Validation:
    """Every segment predicted from the others, by the transfer as well. Shapes (points,)."""
    its = segment[found.taken]
    each = tuple(
        HeldOutSegment(int(k), rms(found.off[its == k]), rms(noise_percent[segment == k]))
        for k in np.unique(its)
    )
    return Validation(held_out=each, held_out_rms_percent=rms(found.off))


def _linear(
    problem: SeveralProblem,
    evidence: Evidence,
    none: Refitted,
    taken: NDArray[np.intp],
) -> _Linear:
    v, dv = response_of(problem, none.effects).with_derivatives(none.law, none.u)
    by = (dv / v)[:, taken]
    plain, bend = none.law.search_widths, none.law.bend_count
    n = len(plain)
    # What has a prior at zero: the bend's whitened values and the stated numbers.
    moved = np.concatenate([np.zeros(n), np.log(none.law.values[n : n + bend]), none.u])
    by[:n] *= plain[:, None]
    measured = problem.sweep.response_m_s[taken]
    r = np.log(measured / v[taken]) + moved @ by
    noise = evidence.sigma_m_s[taken] / np.abs(v[taken])
    by = np.concatenate([by, own_cores(problem.members, none.law, v)[:, taken]])
    t = np.log(problem.sweep.frequency_hz[taken])
    return _Linear(r, by, noise, t, problem.file_of_points[taken])


def _moved(
    problem: SeveralProblem, evidence: Evidence, none: Refitted, linear: _Linear, w: Wandering
) -> Refitted:
    """Where law and stated numbers go by a linear step, the transfer allowed for."""
    J = np.concatenate([linear.by_x.real, linear.by_x.imag], axis=1)
    x = J @ np.linalg.solve(linear.covariance(w), linear.data)
    plain, bend = none.law.search_widths, none.law.bend_count
    n = len(plain)
    logs = np.log(none.law.values)
    logs[:n] += plain * x[:n]
    logs[n:] = x[n : n + bend]
    low, high = none.law.log_limits
    law = none.law.with_logs(np.clip(logs, low, high))
    return evaluated(response_of(problem, none.effects), evidence, law, x[n + bend : n + bend + len(none.u)])


def _likeliest(linear: _Linear, *, common: bool) -> tuple[float, Wandering]:
    """Log evidence with the prior of the sizes, and the sizes. Without `common` there is no g."""

    def wandering(x: Array) -> Wandering:
        sizes = np.exp(np.clip(x, np.log(_LEAST), np.log(_MOST)))
        return Wandering(*sizes) if common else Wandering(0.0, 0.0, *sizes)

    def cost(x: Array) -> float:
        prior = np.sum(((x - np.log(_TYPICAL)) / _SPREAD) ** 2) / 2
        return float(prior - linear.log_evidence(wandering(x)))

    start = np.full(4 if common else 2, np.log(_TYPICAL))
    found = minimize(
        cost,
        start,
        method="Nelder-Mead",
        options={"maxfev": _EVALUATIONS, "fatol": _STILL_NATS, "xatol": _STILL},
    )
    return -float(found.fun), wandering(found.x)


def _from_the_others(linear: _Linear, w: Wandering, segment: NDArray[np.intp]) -> Array:
    C, y = linear.covariance(w), linear.data
    off = np.zeros(len(segment))
    for k in np.unique(segment):
        inside: Mask = np.tile(segment == k, 2)
        known = np.linalg.solve(C[np.ix_(~inside, ~inside)], y[~inside])
        there = (C[np.ix_(inside, ~inside)] @ known)[: int(inside.sum()) // 2]
        off[segment == k] = 100 * np.expm1(there - linear.r.real[segment == k])
    return off
