"""The catalogue tried on a residual, effect by effect."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.candidates import WRONG, Contender, has_place, polished
from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.hands import Hands
from fitting.diagnosis.marginal import cost
from fitting.diagnosis.predictive import checks, form_error, passes, temper
from fitting.diagnosis.refit import Fitted, refit
from fitting.diagnosis.response import Response
from fitting.diagnosis.task import Task
from fitting.diagnosis.work import Begun, Work
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.identification.validation import Validation

Array = NDArray[np.float64]
Report = Callable[[float], None]
NEAR = 40.0
"""In cost above the best: effects so near are gone into twice, where the law so far is no place to begin."""
NEARER = 12.0
"""The same, where it is."""
UNCLEAR = 1.1
"""Chi-square per degree of freedom above which the first pass may have missed the cause."""
PROMISING = 5.0
"""In cost below none's: below it nothing is gone into twice."""
LEADERS = 5
"""Effects that are gone into twice, and that a second one is looked for beside."""
LEFT_BEHIND = 4.0
"""Times the least chi-square: rough fits beyond are not followed to the end."""
SOME = 2
"""Effects that are gone into twice at a time, until one explains everything."""
FIRST = 4
"""Effects that are fitted before all others, where they promise most."""
_SPARE = 2
"""Data a candidate must leave over."""


@dataclass(frozen=True, eq=False)
class Trial:
    """A fitted explanation, what it is worth, and what speaks against it."""

    fitted: Fitted
    cost: float
    """-2 ln of prior times marginal likelihood (`marginal`)."""
    checks: Mapping[str, float] = field(default_factory=dict)
    """Tail probabilities of posterior predictive checks (`predictive`)."""

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects; empty for none."""
        return tuple(e.name for e in self.fitted.effects)

    @property
    def fails(self) -> bool:
        """Whether such data are not what it would leave."""
        return not passes(self.checks)


class Search:
    """Fits of one set of data."""

    def __init__(
        self,
        task: Task,
        evidence: Evidence,
        none: Fitted,
        effects: Sequence[Effect],
        hands: Hands,
        unnamed: Sequence[Effect] = (),
    ) -> None:
        """`unnamed` are fitted alone, for comparison, and never named."""
        self.task, self.evidence, self.hands = task, evidence, hands
        self.stated = stated = none.law
        self._found_at_once = False
        self._validations: dict[int, tuple[Trial, Validation]] = {}
        self.effects, self.unnamed = (
            [e for e in some if e.objection(task.points, task.plate) is None] for some in (effects, unnamed)
        )
        fitted = [e for e in (*self.effects, *self.unnamed) if not e.laws(stated, task.points)]
        # Those that take longest come first: hands then end at the same time.
        self._fitted = sorted(fitted, key=has_place, reverse=True)
        self.work = Work(task, evidence, none, [*self.effects, *self.unnamed])
        self._none = none
        self.none = self.judged(none)

    def with_evidence(self, evidence: Evidence) -> "Search":
        """The same search of data that are worth something else."""
        none = self.none.fitted
        again = refit(Response(self.task, ()), evidence, none.law, none.u)
        return Search(self.task, evidence, again, self.effects, self.hands, self.unnamed)

    def judged(self, fitted: Fitted) -> Trial:
        """A fit with what it is worth."""
        found = checks(self.task.sweep, self.evidence, self._none, fitted)
        return Trial(fitted, cost(fitted, self.task.plate), found)

    def temper(self, best: Trial) -> float:
        """How much less a difference of costs says, where the best explains far more than noise."""
        return temper(self._none, best.fitted) if self.evidence.scale_known else 1.0

    def allowed(self, trial: Trial) -> float:
        """Chi-square per degree of freedom that the formulas of a trial's effects may leave."""
        dof = max(1, trial.fitted.data - trial.fitted.parameters)
        return 1 + form_error(self._none, trial.fitted) / dof

    def validation(self, trial: Trial) -> Validation:
        """What a trial says of data it has not seen."""
        key = id(trial)
        if key not in self._validations:
            self._validations[key] = trial, self.work.held_out(trial.fitted)
        return self._validations[key][1]

    def alone(self, trial: Trial) -> list[Trial]:
        """Each effect of a pair fitted alone from where the pair left it."""
        pair = trial.fitted
        if any(e.replaces_law for e in pair.effects):
            return []
        return [
            self.judged(
                polished(self.task, [e], self.evidence, pair.law, np.concatenate([pair.z, pair.of(e)]))
            )
            for e in pair.effects
        ]

    def singles(self, report: Report) -> list[Trial]:
        """Every effect beside the law, best first; the leading ones are gone into twice."""
        found: dict[str, Trial] = {}
        work, each = self.work, self.hands.each

        def keep(fits: Iterable[Fitted]) -> None:
            for trial in (self.judged(f) for f in fits if self._determined(f)):
                name = trial.names[0]
                if name not in found or trial.cost < found[name].cost:
                    found[name] = trial

        def begin(tasks: Iterable[Begun]) -> None:
            for begun in tasks:
                if begun.state:
                    work.learn(begun.name, begun.state)
                keep(begun.fits)

        laws = [e.name for e in self.effects if e not in self._fitted]
        names = [e.name for e in self._fitted]
        first, self._found_at_once = self._leading(names), False
        if first:
            begin(each(work.begun, [(n, work.state(n)) for n in first], lambda x: report(0.1 + 0.1 * x)))
            leader = min(found.values(), key=lambda t: t.cost).names[0]
            keep(each(work.finished, work.best_near(leader)))
        left = [n for n in (*laws, *names) if n not in first]
        best = min(found.values(), key=lambda t: t.cost, default=self.none)
        if best is not self.none and self._settles(best):
            self._found_at_once = True
            again = [(n, work.state(n), best.fitted) for n in (*laws, *names) if n not in best.names]
            begin(each(work.beside_the_best, again, lambda x: report(0.2 + 0.2 * x)))
        else:
            begin(each(work.begun, [(n, work.state(n)) for n in left], lambda x: report(0.2 + 0.2 * x)))
        ahead = [best for name in self._ahead(found) for best in work.best_near(name)]
        keep(each(work.finished, ahead, lambda x: report(0.4 + 0.2 * x)))
        further = self._worth_more(found)
        while further:
            some, further = (further[:SOME], further[SOME:]) if self._astray else (further, [])
            tasks = [(name, work.state(name), self._astray) for name in some]
            for fits in each(work.thorough, tasks, lambda x: report(0.6 + 0.2 * x)):
                keep(fits)
            best = min(found.values(), key=lambda t: t.cost)
            if self._astray and self._settles(best):
                again = [(n, work.state(n), best.fitted) for n in (*laws, *names) if n not in best.names]
                begin(each(work.beside_the_best, again, lambda x: report(0.8 + 0.1 * x)))
                break
        places = [(name, work.state(name)) for name in self._misplaced(found)]
        for fits in each(work.everywhere, places, lambda x: report(0.9 + 0.1 * x)):
            keep(fits)
        return sorted(found.values(), key=lambda t: t.cost)

    def _leading(self, names: Sequence[str]) -> list[str]:
        """Where something is left to be explained, the effects that promise most of it."""
        work = self.work
        for name, state in zip(names, self.hands.each(work.starts, names), strict=True):
            work.learn(name, state)
        order = sorted(names, key=work.promise, reverse=True)[:FIRST]
        clean = self.none.fitted.chi2_per_dof < UNCLEAR and work.promise(order[0]) < NEAR
        return [] if clean else order

    def _settles(self, trial: Trial) -> bool:
        """Whether an effect explains all there is."""
        best = trial.fitted
        enough = self.none.cost - trial.cost > PROMISING and best.chi2_per_dof < UNCLEAR
        return enough and not trial.fails and not any(e.replaces_law for e in best.effects)

    def _determined(self, fitted: Fitted) -> bool:
        return fitted.parameters <= self.evidence.count - _SPARE

    def _ahead(self, found: Mapping[str, Trial]) -> list[str]:
        """Effects whose rough fit is among the best or not far behind."""
        if self._astray:
            order = sorted(found.values(), key=lambda t: t.fitted.chi2)
            near = [t for t in order if t.fitted.chi2 < LEFT_BEHIND * order[0].fitted.chi2]
        else:
            order = sorted(found.values(), key=lambda t: t.cost)
            near = [t for t in order if t.cost < order[0].cost + NEARER]
        names = {t.names[0] for t in near[: 2 * LEADERS]}
        return [e.name for e in self._fitted if e.name in names]

    def _worth_more(self, found: Mapping[str, Trial]) -> list[str]:
        """Effects that better starts might bring to the top, after a first pass."""
        order = sorted(found.values(), key=lambda t: t.cost)
        if not order or self.none.cost - order[0].cost < PROMISING:
            return []
        fitted = {e.name: e for e in self._fitted if e.unknowns}
        if not self._astray and not order[0].fails:
            # What has no place to be found is where it belongs by now.
            near = (t.names[0] for t in order if t.cost < min(order[0].cost + NEARER, self.none.cost))
            return [name for name in near if name in fitted and has_place(fitted[name])]
        names = {t.names[0] for t in order if t.cost < order[0].cost + NEAR}
        best = order[0].fitted
        if not best.chi2_per_dof < UNCLEAR or any(e.replaces_law for e in best.effects):
            plain = self._promising()
            names |= {t.names[0] for t in order[:LEADERS]} | set(plain)
            rank = [*plain, *(t.names[0] for t in order)]
            return sorted((name for name in fitted if name in names), key=rank.index)
        return [name for name in fitted if name in names]

    @property
    def _astray(self) -> bool:
        """Whether the law so far is no place to begin."""
        return self.none.fitted.chi2_per_dof > WRONG and not self._found_at_once

    def _misplaced(self, found: Mapping[str, Trial]) -> list[str]:
        """Where all that lead fail, those of them whose right place may not have been among the first."""
        order = sorted(found.values(), key=lambda t: t.cost)
        if not order or self.none.cost - order[0].cost < PROMISING:
            return []
        effects = {e.name: e for e in self._fitted}
        leading = [t for t in order if t.cost < order[0].cost + NEAR and t.names[0] in effects]
        if not all(t.fails for t in leading):
            return []
        return [t.names[0] for t in leading if has_place(effects[t.names[0]])]

    def _promising(self) -> list[str]:
        """Where the law so far is no place to begin: the effects that do best from plain starts."""
        return self.order_of_plain()[:LEADERS] if self._astray else []

    def order_of_plain(self) -> list[str]:
        """Effects by how well they do from plain starts, in wide valleys."""
        work = self.work
        names = [e.name for e in self._fitted if e.unknowns]
        chi2 = []
        for name, state in zip(
            names, self.hands.each(work.plain, [(n, work.state(n)) for n in names]), strict=True
        ):
            work.learn(name, state)
            chi2.append(min(f.chi2 for f in state[0]["plain"]))
        return [names[k] for k in np.argsort(chi2)]

    def told(self, effects: Sequence[Effect]) -> Trial:
        """These effects together, none of them weighed; `FittingError` where the data cannot carry one."""
        fitted = self.none.fitted
        # Another law comes first: the others are then fitted beside it.
        for effect in sorted(effects, key=lambda e: not e.replaces_law):
            objection = effect.objection(self.task.points, self.task.plate)
            if objection is not None:
                raise OutsideModel(f"{effect.name}: {objection}")
            if effect.replaces_law:
                fits = self.work.other_laws(effect)
                fitted = min(fits, key=lambda f: self.judged(f).cost)
                continue
            contenders = [Contender(self.task, self.evidence, fitted, form) for form in effect.variants()]
            fits = [c.finished(f) for c in contenders for f in [*c.near[:1], *c.far[:1]]]
            fitted = min(fits, key=lambda f: f.chi2)
        return self.judged(fitted)
