"""Evidence by resampling: what the same search makes of data without any effect, and with some left out.

A search over many causes finds something in noise, too. How much, only the search itself can tell.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.begin import begin
from fitting.diagnosis.evidence import BareModes
from fitting.diagnosis.hands import Hands
from fitting.diagnosis.refit import Fitted
from fitting.diagnosis.response import Response
from fitting.diagnosis.search import Search, Trial
from fitting.diagnosis.singles import Singles
from fitting.diagnosis.task import Task
from fitting.diagnosis.verdict import judge
from fitting.effects.base import Effect
from fitting.identification.result import differences_percent
from fitting.identification.validation import MOST_POINTS_ONE_BY_ONE, rms
from fitting.laws import CoreLaw
from fitting.noise import Noise, noise_of
from fitting.reduced import ReducedPlate
from fitting.sweep import Sweep

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Report = Callable[[float], None]

SMALL = MOST_POINTS_ONE_BY_ONE
"""Points up to which resampling is always done."""
REPEATS = 19
"""Sweeps without any effect for a p-value: a step of five percent."""


@dataclass(frozen=True)
class Again:
    """A search that can be done once more with other data of the same plate."""

    task: Task
    remade: Callable[[Sweep], Task]
    """The task of some of the points."""
    reduced: ReducedPlate
    effects: Sequence[Effect]
    bare: BareModes | None
    start: CoreLaw
    none: Fitted
    """The fit without effects: what sweeps without any are drawn from."""
    noise: Noise

    def searched(self, task: Task) -> tuple[Search, list[Trial]]:
        """Every effect alone, as the search of the data themselves begins."""
        begun = begin(task, self.reduced, noise_of(task.sweep), self.bare, self.start)
        search = Search(begun.task, begun.evidence, begun.none, self.effects, Hands())
        return search, Singles(search, lambda fraction: None).best()

    def gain_without_effect(self, seed: int) -> float:
        """What the best explanation gains on a sweep drawn from the fit without effects."""
        rng = np.random.default_rng([_SEED, seed])
        search, trials = self.searched(replace(self.task, sweep=self._drawn(rng)))
        return gain(search.none, trials)

    def _drawn(self, rng: np.random.Generator) -> Sweep:
        sweep, v = self.task.sweep, self.none.velocity_m_s
        if self.noise.is_known:
            sigma = self.noise.std_m_s
        else:
            dof = max(1, self.none.data - self.none.parameters)
            sigma = np.abs(v) * rms(differences_percent(sweep, v) / 100) * np.sqrt(len(sweep) / dof)
        n = len(v)
        if sweep.has_phase:
            drawn = v + sigma * (rng.standard_normal(n) + 1j * rng.standard_normal(n))
        else:
            drawn = np.abs(np.abs(v) + sigma * rng.standard_normal(n))
        return replace(sweep, velocity_m_s=drawn, base_m_s2=None)

    def left_out(self, held: Mask) -> Array:
        """100 (|predicted| - |measured|)/|measured| of points held out, the search repeated without them."""
        task = self.remade(self.task.sweep.take(~held))
        search, trials = self.searched(task)
        judged = judge(
            search.none,
            trials,
            temper=search.temper(min([search.none, *trials], key=lambda t: t.cost)),
            hidden=frozenset(),
            held_out=lambda trial: float("nan"),
        )
        best = (judged.accepted or search.none).fitted
        whole = self.task.condensed(best.law).around(best.law)
        v = Response(whole, best.effects).velocity(best.law, best.u)
        return differences_percent(self.task.sweep, v)[held]


def gain(none: Trial, trials: Sequence[Trial]) -> float:
    """How much better the best explanation is than none, in -2 ln of prior times marginal likelihood."""
    return max((none.cost - t.cost for t in trials), default=-np.inf)


@dataclass(frozen=True)
class Resampled:
    """What resampling said; None for what was not asked for, or cannot be."""

    p_value: float | None = None
    """Chance that a sweep without any effect gains as much."""
    nested_rms_percent: float | None = None
    """Error on points left out one by one, or segments, the selection repeated each time."""


def resampled_of(again: Again, found: float, repeats: int | None, hands: Hands, report: Report) -> Resampled:
    """Both; `found` is the gain of the data. Nothing where points are many and nobody asks."""
    if repeats is None:
        repeats = REPEATS if len(again.task.sweep) <= SMALL else 0
    if not repeats:
        return Resampled()
    gains = list(hands.each(again.gain_without_effect, list(range(repeats)), report))
    p = (1 + sum(g >= found for g in gains)) / (1 + repeats)
    return Resampled(p, nested_rms_percent(again, hands, report))


def nested_rms_percent(again: Again, hands: Hands, report: Report) -> float | None:
    """Error on points left out one by one, or segments; None where nothing can be learnt without them."""
    sweep = again.task.sweep
    if len(sweep) <= SMALL:
        folds = [np.arange(len(sweep)) == k for k in range(len(sweep))]
    else:
        folds = [sweep.segment == number for number in np.unique(sweep.segment)]
    numbers = (len(sweep) - 1) * (2 if sweep.has_phase else 1)
    if len(folds) < 2 or numbers <= len(again.start.names):
        return None
    return rms(np.concatenate(list(hands.each(again.left_out, folds, report))))


_SEED = 20
