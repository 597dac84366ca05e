"""A fit followed to where it ends; the law of usual size nearest to another.

A fit may end far outside of what cores are, in a valley of its own: what the law does in the band it does as
well from there.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.optimize import OptimizeResult, least_squares

from fitting.arrays import Array
from fitting.diagnosis.executor import ALONE, Executor
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import CONVERGED, refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.inference.wide_valley import with_stated
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.thresholds import STOPPING
from fitting.effects.base import Effect
from fitting.laws import CoreLaw

_ROUNDS = 3
"""As many grids at most: a bound on time."""
_FAR = 0.02
"""Relative change of the modulus from which the grid is made anew for the new poles. A choice."""
_FAR_OF_STRAIN = 0.002
"""The same where softening is told for the strain under the law that its fit starts from."""
_MOST_POINTS = 48
"""Of a sweep that a law is compared at: moduli are smooth. A choice."""
_NEAR = 0.1
"""In ln G* at any frequency: as far as a usual law may be off another and be a place to begin beside it."""
_INSIDE = float(np.log(3))
"""Of a parameter's logarithm: so far within its limits is no limit. A choice."""
_OPEN = 1e-9
"""A range of one value is none for a bounded fit."""


def followed(
    problem: DiagnosisProblem, evidence: Evidence, fitted: Refitted, executor: Executor = ALONE
) -> Refitted:
    """A fit followed to its very end, from where its law is of usual size too if it is not."""
    ways = _Ways(problem, evidence)
    if ways.usual(fitted) is not fitted.law:
        # Neither way needs to know of the other: two processes go one each.
        both = executor.together([(ways.on, (fitted,)), (ways.from_usual, (fitted,))])
        return min(both, key=by_chi2)
    found = ways.on(fitted)
    if ways.usual(found) is found.law:
        return found
    return min(found, ways.from_usual(found), key=by_chi2)


@dataclass(frozen=True)
class _Ways:
    """How a fit may be followed."""

    problem: DiagnosisProblem
    evidence: Evidence

    def usual(self, fitted: Refitted) -> CoreLaw:
        """The law of usual size nearest to its own."""
        return within_search(fitted.law, self.problem.points.omega)

    def on(self, fitted: Refitted) -> Refitted:
        """From where it is."""
        return followed_to_convergence(self.problem, self.evidence, fitted)

    def from_usual(self, fitted: Refitted) -> Refitted:
        """From the law of usual size; itself where that cannot come as far."""
        # What ends no lower is the same, or worse.
        law, goal = self.usual(fitted), fitted.chi2 - STOPPING.least_owed
        again = polished(self.problem, fitted.effects, self.evidence, law, fitted.u, goal)
        if not again.may_reach(goal):
            return fitted
        found = followed_to_convergence(self.problem, self.evidence, again, goal)
        return found if found.chi2 <= goal else fitted


def polished(
    problem: DiagnosisProblem,
    effects: Sequence[Effect],
    evidence: Evidence,
    law: CoreLaw,
    u: Array,
    goal: float = np.inf,
) -> Refitted:
    """A fit to the end, its grid made for the law it starts from, and again where the law has moved far.

    `u` of shape (unknowns,). `goal` as `refit` takes it.
    """
    for _ in range(_ROUNDS):
        fitted = refit(response_of(problem.around(law), effects), evidence, law, u, goal=goal)
        if fitted.chi2_per_dof > STOPPING.hopeless_chi2_per_dof or not fitted.may_reach(goal):
            break
        if _is_near(problem, law, fitted):
            break
        law, u = fitted.law, fitted.u
    return fitted


def _is_near(problem: DiagnosisProblem, law: CoreLaw, fitted: Refitted) -> bool:
    """Whether a grid made for a law serves where a fit that began from it has ended."""
    omega = problem.fine.nodes.omega
    moved = np.max(np.abs(fitted.law.modulus(omega) / law.modulus(omega) - 1))
    by_strain = any(span.strains for e in fitted.effects for span in e.spans)
    return bool(moved < (_FAR_OF_STRAIN if by_strain else _FAR))


def finished(
    problem: DiagnosisProblem, evidence: Evidence, rough: Refitted, goal: float = np.inf
) -> Refitted:
    """A rough fit to the end as `polished` does it, or to where a chi-square of `goal` is out of reach.

    One that had not come to its end first goes on as it was begun, on few nodes and motions, while it gains:
    a step takes two thirds of the time there, and what they leave out is made good by the last steps.
    """
    law, u = rough.law, with_stated(problem, rough)
    if not rough.converged:
        here = problem.around(law)
        rough = refit(response_of(here, rough.effects, here.coarse), evidence, law, u, goal=goal)
        if not rough.may_reach(goal):
            return rough
        law, u = rough.law, rough.u
    return polished(problem, rough.effects, evidence, law, u, goal)


def followed_to_convergence(
    problem: DiagnosisProblem, evidence: Evidence, fitted: Refitted, goal: float = np.inf
) -> Refitted:
    """A fit followed until nothing is left to be gained, or `goal` is out of reach; itself where it is there.

    What was followed far enough to compare may be on its way still, along a valley that winds: there
    chi-square hardly falls from step to step, and the law has far to go.
    """
    if fitted.converged and fitted.owed < STOPPING.least_owed:
        return fitted
    response = response_of(problem.around(fitted.law), fitted.effects)
    least = STOPPING.least_owed
    found = refit(response, evidence, fitted.law, fitted.u, tolerance=CONVERGED, goal=goal, least=least)
    if fitted.chi2 - found.chi2 < STOPPING.least_owed:
        # Nothing is left to gain: one that was only cut short there has come to its end.
        return replace(fitted, converged=fitted.converged or found.converged)
    if _is_near(problem, fitted.law, found):
        return found
    return polished(problem, found.effects, evidence, found.law, found.u)


def within_search(law: CoreLaw, omega: Array) -> CoreLaw:
    """The law of the ranges that are searched whose modulus is nearest to a law's; itself where it is one.

    Where none of them is near, as of a core much stiffer than usual ones, ranges reach as far as its own
    parameters do. `omega` in rad/s, shape (points,).
    """
    low, high = np.log([q.search for q in law.limits]).T
    logs = np.log(law.values)
    if np.all((logs >= low) & (logs <= high)):
        return law
    some = np.unique(np.linspace(0, len(omega) - 1, _MOST_POINTS).round().astype(int))
    return _nearest_within(law, omega[some].tobytes())


@lru_cache(maxsize=64)
def _nearest_within(law: CoreLaw, omega_bytes: bytes) -> CoreLaw:
    """Kept: every effect begins from the same law."""
    omega = np.frombuffer(omega_bytes)
    low, high = np.log([q.search for q in law.limits]).T
    wanted = np.log(law.modulus(omega))

    def off(p: Array) -> Array:
        d = np.log(law.with_logs(p).modulus(omega)) - wanted
        return np.concatenate([d.real, d.imag])

    def slope(p: Array) -> Array:
        one = law.with_logs(p)
        d = one.jacobian(omega) * one.values[:, None] / one.modulus(omega)
        return np.concatenate([d.real, d.imag], axis=1).T

    def nearest(low: Array, high: Array) -> OptimizeResult:
        bounds = (low - _OPEN, high + _OPEN)
        return least_squares(off, np.clip(own, low, high), jac=slope, bounds=bounds)

    own = np.log(law.values)
    found = nearest(low, high)
    if np.max(np.abs(found.fun)) > _NEAR:
        least, most = law.log_limits
        reach_down = np.minimum(low, np.maximum(own, least + _INSIDE))
        found = nearest(reach_down, np.maximum(high, np.minimum(own, most - _INSIDE)))
    return law.with_logs(found.x)
