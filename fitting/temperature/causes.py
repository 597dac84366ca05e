"""What else than the material may set temperatures apart: a cause that all sweeps have in common.

A delay, a gain, a spot, a clamp that is not as stated bends every sweep's law its own way, so that no shift
lays them over each other. Before a law is called not simple, each effect of the catalogue is given to all
sweeps at once, with one set of unknowns, under one law and under a law for each alike.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.executor import ALONE, Executor
from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.search.stand_in import has_no_size
from fitting.diagnosis.thresholds import VERDICT
from fitting.diagnosis.verdict.result import FoundEffect
from fitting.diagnosis.verdict.stage import found_effects
from fitting.effects.base import Effect
from fitting.progress import Report, unheard
from fitting.temperature.joint import TemperatureProblem, fit_shifted
from fitting.temperature.members import Alone, Begun, Joined
from fitting.temperature.shifted_fit import ShiftedFit

REFUSED = 1e-3
"""Tail probability below which one law is refused."""
_ENTRIES = ("channel", "observation", "stiffness", "mass", "load", "damping")
"""Where a cause enters that a plate keeps from temperature to temperature: not the core, nor a time."""
_FOLLOWED = 6
"""Causes fitted to all sweeps, of those that promise enough; a choice."""
_ENOUGH = 0.5
"""Of what one law lacks: a cause that by a linear step promises less is not followed."""
_LEADING = 3
"""Causes fitted to all sweeps, of those that explain the worst sweep best; a choice."""

Join = Callable[[Sequence[Begun]], Joined]
"""Fits of members by themselves, side by side."""


@dataclass(frozen=True)
class Cause:
    """One effect in all sweeps, under one law and under a law for each."""

    effect: Effect
    fit: ShiftedFit
    cost: float
    """Of the one law with it, as diagnoses weigh explanations."""

    found: FoundEffect
    """The effect with its sizes and their errors."""

    without: ShiftedFit | None = None
    """The same without it, from where the fit with it ended; None where one law does not serve beside it.

    A fit that was stuck comes off as the effect goes in: what explains the data then is not the effect.
    """
    gain: float = 0.0
    """By how much `cost` is less than without it."""

    @property
    def serves(self) -> bool:
        """Whether one shifted law explains all there is beside it, and the effect is there."""
        return self._is_there and self.fit.one.converged

    @property
    def may_serve(self) -> bool:
        """Whether all that it lacks to serve is that its fit has not come to its end."""
        return self._is_there and not self.fit.one.converged

    @property
    def _is_there(self) -> bool:
        return one_law_serves(self.fit) and self.gain > 0 and not has_no_size(self.fit.one)


def one_law_serves(fit: ShiftedFit) -> bool:
    """Whether a law of each temperature explains the readings, and one law does as well."""
    return explains(fit) and fit.p_value >= REFUSED


def explains(fit: ShiftedFit) -> bool:
    """Whether a law for each temperature leaves no more than noise, where that is known."""
    return not fit.noise_known or fit.own_chi2_per_dof <= VERDICT.size


def common(effects: Sequence[Effect]) -> list[Effect]:
    """Effects that a plate and its rig may have at every temperature alike."""
    return [e for e in effects if e.enters in _ENTRIES and not e.replaces_law and e.parameters]


def causes_of(
    alone: Sequence[Alone],
    problem: TemperatureProblem,
    fit: ShiftedFit,
    effects: Sequence[Effect],
    join: Join,
    executor: Executor = ALONE,
    report: Report = unheard,
) -> list[Cause]:
    """The causes that come nearest, with one law beside them; the best first.

    `problem` is of the models of `alone`, which `join` puts side by side.
    """
    able = [e for e in effects if e.objection(problem.joined.points, problem.joined.plate) is None]
    if explains(fit):
        found = [_beside(problem, fit, e, u) for e, u in _promising(problem, fit, able)]
    else:
        found = []
        for k, effect in enumerate(leading := _of_the_worst(alone, able, executor)):
            found += _from_each(alone, problem, join, effect)
            report((k + 1) / len(leading))
    return sorted(found, key=lambda c: (not c.serves, c.cost))


def without_any(causes: Sequence[Cause]) -> ShiftedFit | None:
    """The best fit of one law that serves without the effect it was found beside; None where none does."""
    bare = [c.without for c in causes if c.without is not None and one_law_serves(c.without)]
    return min(bare, key=lambda fit: fit.chi2, default=None)


def _promising(
    problem: TemperatureProblem, fit: ShiftedFit, effects: Sequence[Effect]
) -> list[tuple[Effect, Array]]:
    """With where to start: each temperature is explained by itself, so one law is near enough for a step."""
    lacking = fit.chi2 - fit.chi2_own
    forms = [form for e in effects for form in e.forms(problem.joined.points, problem.joined.plate)]
    looks = [(form, problem.joined.starts(form, fit.one)) for form in forms]
    able = [(form, starts[0]) for form, starts in looks if starts]
    able = [one for one in able if one[1][0] == 0 or one[1][0] > _ENOUGH * lacking]
    able.sort(key=lambda one: -one[1][0])
    return [(form, start[1]) for form, start in able[:_FOLLOWED]]


def _beside(problem: TemperatureProblem, fit: ShiftedFit, effect: Effect, u: Array) -> Cause:
    one = problem.fitted(fit.one.law, np.append(fit.one.u, u), [effect])
    own = problem.fitted(fit.own.law, np.append(fit.own.u, one.of(effect)), [effect])
    return _cause(problem, problem.both(one, own))


def _cause(problem: TemperatureProblem, fit: ShiftedFit) -> Cause:
    plate = problem.joined.plate
    (effect,) = fit.one.effects
    if one_law_serves(fit) and not fit.one.converged:
        # It would serve but for a few steps more.
        fit = replace(fit, one=problem.fitted(fit.one.law, fit.one.u, [effect]))
    (found,) = found_effects(fit.one, plate)
    cause = Cause(effect, fit, cost(fit.one, plate), found)
    if not one_law_serves(fit):
        return cause
    one, own = (problem.fitted(f.law, f.z) for f in (fit.one, fit.own))
    return replace(cause, without=problem.both(one, own), gain=cost(one, plate) - cause.cost)


def _of_the_worst(alone: Sequence[Alone], effects: Sequence[Effect], executor: Executor) -> list[Effect]:
    """What explains the member best that its own law explains worst."""
    worst = max(alone, key=lambda a: a.begun.none.chi2_per_dof)
    return worst.leading(effects, executor)[:_LEADING]


def _from_each(
    alone: Sequence[Alone], problem: TemperatureProblem, join: Join, effect: Effect
) -> list[Cause]:
    """Fitted to each member by itself first: without it no law so far is a place to begin."""
    each = [a.beside(effect).begun for a in alone]
    u = np.median([b.none.of(effect) for b in each], axis=0)
    again = replace(problem, joined=join(each), begin=None)
    z = again.stated([b.none.z for b in each])
    fit = fit_shifted(again, [b.none.law for b in each], z, [effect], u)
    return [_cause(again, fit)]
