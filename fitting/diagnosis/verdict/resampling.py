"""Evidence by resampling: what the same search makes of data without any effect, and with some left out.

A search over many causes finds something in noise, too. How much, only the search itself can tell.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array, Mask
from fitting.data.noise import noise_of
from fitting.diagnosis.executor import Executor
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search
from fitting.diagnosis.search.singles import Singles
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.verdict.case import DiagnosisCase
from fitting.diagnosis.verdict.judgement import judge
from fitting.identification.result import differences_percent
from fitting.identification.validation import MOST_POINTS_ONE_BY_ONE, rms
from fitting.progress import Report, unheard
from fitting.sweep import Sweep

SMALL = MOST_POINTS_ONE_BY_ONE
"""Points up to which resampling is always done."""
_OF_REPEATS = 0.5
"""Share of resampling that the repeats are, beside leaving out what is predicted."""
REPEATS = 19
"""Sweeps without any effect for a p-value: a step of five percent."""


@dataclass(frozen=True)
class Again:
    """A search that can be done once more with other data of the same plate."""

    case: DiagnosisCase
    remade: Callable[[Sweep], DiagnosisProblem]
    """The case's problem of some of the points."""
    none: Refitted
    """The fit without effects: what sweeps without any are drawn from."""

    def searched(self, problem: DiagnosisProblem) -> tuple[Search, list[ScoredFit]]:
        """Every effect alone, as the search of the data themselves begins."""
        case = self.case
        begun = begin(problem, case.reduced, noise_of(problem.sweep), case.bare, case.start)
        search = Search(begun.problem, begun.evidence, begun.none, case.effects, Executor())
        return search, Singles(search, unheard).best()

    def gain_without_effect(self, seed: int) -> float:
        """What the best explanation gains on a sweep drawn from the fit without effects."""
        rng = np.random.default_rng([_SEED, seed])
        search, scored_fits = self.searched(replace(self.case.problem, sweep=self._drawn(rng)))
        return gain(search.none, scored_fits)

    def _drawn(self, rng: np.random.Generator) -> Sweep:
        sweep, v, noise = self.case.problem.sweep, self.none.velocity_m_s, self.case.noise
        if noise.is_known:
            sigma = noise.std_m_s
        else:
            dof = max(1, self.none.data - self.none.parameter_count)
            sigma = np.abs(v) * rms(differences_percent(sweep, v) / 100) * np.sqrt(len(sweep) / dof)
        n = len(v)
        if sweep.has_phase:
            drawn = v + sigma * (rng.standard_normal(n) + 1j * rng.standard_normal(n))
        else:
            drawn = np.abs(np.abs(v) + sigma * rng.standard_normal(n))
        return replace(sweep, velocity_m_s=drawn, base_m_s2=None)

    def left_out(self, held: Mask) -> Array:
        """100 (|predicted| - |measured|)/|measured| of points held out, the search repeated without them.

        Shape (held out,), of `held` (points,).
        """
        problem = self.case.problem
        search, scored_fits = self.searched(self.remade(problem.sweep.take(~held)))
        judged = judge(
            *search.tempered(scored_fits),
            held_out=lambda scored: float("nan"),
        )
        best = (judged.accepted or search.none).fitted
        whole = problem.condensed(best.law).around(best.law)
        v = response_of(whole, best.effects).velocity(best.law, best.u)
        return differences_percent(problem.sweep, v)[held]


def gain(none: ScoredFit, scored_fits: Sequence[ScoredFit]) -> float:
    """How much better the best explanation is than none, in -2 ln of prior times marginal likelihood."""
    return max((none.cost - t.cost for t in scored_fits), default=-np.inf)


@dataclass(frozen=True)
class Resampled:
    """What resampling said; None for what was not asked for, or cannot be."""

    p_value: float | None = None
    """Chance that a sweep without any effect gains as much, itself counted among them."""
    repeats: int = 0
    """On how many such sweeps."""
    nested_rms_percent: float | None = None
    """Error on points left out one by one, or segments, the selection repeated each time."""


def resampled_of(
    again: Again, found: float, repeats: int | None, executor: Executor, report: Report
) -> Resampled:
    """Both; `found` is the gain of the data. Nothing where points are many and nobody asks."""
    repeats = repeats_of(len(again.case.problem.sweep), repeats)
    if not repeats:
        return Resampled()
    tasks = list(range(repeats))
    gains = list(executor.map(again.gain_without_effect, tasks, lambda x: report(_OF_REPEATS * x)))
    p = (1 + sum(g >= found for g in gains)) / (1 + repeats)
    nested = nested_rms_percent(again, executor, lambda x: report(_OF_REPEATS + (1 - _OF_REPEATS) * x))
    return Resampled(p, repeats, nested)


def repeats_of(points: int, wanted: int | None) -> int:
    """On how many sweeps without any effect the search is repeated; None wants it where points are few."""
    return (REPEATS if points <= SMALL else 0) if wanted is None else wanted


def nested_rms_percent(again: Again, executor: Executor, report: Report) -> float | None:
    """Error on points left out one by one, or segments; None where nothing can be learnt without them."""
    sweep = again.case.problem.sweep
    if len(sweep) <= SMALL:
        folds = [np.arange(len(sweep)) == k for k in range(len(sweep))]
    else:
        folds = [sweep.segment == number for number in np.unique(sweep.segment)]
    numbers = (len(sweep) - 1) * (2 if sweep.has_phase else 1)
    if len(folds) < 2 or numbers <= len(again.case.start.names):
        return None
    return rms(np.concatenate(list(executor.map(again.left_out, folds, report))))


_SEED = 20
"""The same draws whenever a diagnosis is repeated."""
