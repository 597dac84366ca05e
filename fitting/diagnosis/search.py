"""The catalogue tried on a residual, effect by effect."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.candidates import WRONG, Contender, has_place, polished
from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.hands import Hands
from fitting.diagnosis.model_error import excess
from fitting.diagnosis.refit import Fitted, refit
from fitting.diagnosis.response import Response
from fitting.diagnosis.task import Task
from fitting.diagnosis.work import Work
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.identification.validation import Validation

Array = NDArray[np.float64]
Report = Callable[[float], None]
NEAR = 40.0
"""In BIC, above the best: effects so near are gone into twice."""
UNCLEAR = 1.1
"""Chi-square per degree of freedom above which the first pass may have missed the cause."""
PROMISING = 5.0
"""In BIC, over none: below it nothing is gone into twice."""
LEADERS = 5
"""Effects that are gone into twice, and that a second one is looked for beside."""
LEFT_BEHIND = 4.0
"""Times the least chi-square: rough fits beyond are not followed to the end."""
_SPARE = 2
"""Data a candidate must leave over."""


@dataclass(frozen=True, eq=False)
class Trial:
    """A fitted candidate and its evidence: chi-square with every parameter paid for (BIC)."""

    fitted: Fitted
    bic: float
    leans: bool = False
    """Whether it fits only by bending the plate more than a layer-wise plate and its own model are wrong."""

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects; empty for none."""
        return tuple(e.name for e in self.fitted.effects)


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
        self._choosing: dict[str, float] = {}
        self._validations: dict[int, tuple[Trial, Validation]] = {}
        self.effects, self.unnamed = (
            [e for e in some if e.objection(task.points, task.plate) is None] for some in (effects, unnamed)
        )
        fitted = [e for e in (*self.effects, *self.unnamed) if not e.laws(stated, task.points)]
        # Those that take longest come first: hands then end at the same time.
        self._fitted = sorted(fitted, key=has_place, reverse=True)
        self.work = Work(task, evidence, none, [*self.effects, *self.unnamed])
        self.none = self.judged(none)

    def with_evidence(self, evidence: Evidence) -> "Search":
        """The same search of data that are worth something else."""
        none = self.none.fitted
        again = refit(Response(self.task, ()), evidence, none.law, none.u)
        return Search(self.task, evidence, again, self.effects, self.hands, self.unnamed)

    def judged(self, fitted: Fitted) -> Trial:
        """A fit with what it costs."""
        n = self.evidence.count + (len(self.evidence.bare.shift) if self.evidence.bare else 0)
        parameters = fitted.parameters
        if any(e.replaces_law for e in fitted.effects):
            # One of many laws: choosing is a parameter too, and none counts less than the stated one.
            parameters = max(parameters, len(self.stated.names)) + 2
        paid = parameters * np.log(n) + sum(self._choices(e) for e in fitted.effects)
        if self.evidence.scale_known:
            bic = fitted.chi2 + paid
            return Trial(fitted, bic, self._leans(fitted, bic))
        # Noise of unknown size: its estimate is in the likelihood.
        return Trial(fitted, n * np.log(max(fitted.chi2, 1e-300) / n) + paid)

    def _leans(self, fitted: Fitted, bic: float) -> bool:
        if not fitted.effects:
            return False
        own = max(e.bends for e in fitted.effects) * (self.none.bic - bic)
        return excess(self.evidence, fitted) > max(own, 0.0)

    def _choices(self, effect: Effect) -> float:
        """What it costs that a place was chosen among many: one of them fits noise best."""
        if effect.name not in self._choosing:
            many = len(effect.starts(self.task.plate, self.task.points)) if has_place(effect) else 1
            self._choosing[effect.name] = 2 * float(np.log(many))
        return self._choosing[effect.name]

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
            self.judged(polished(self.task, [e], self.evidence, pair.law, pair.of(e), self.work.priors([e])))
            for e in pair.effects
        ]

    def singles(self, report: Report) -> list[Trial]:
        """Every effect beside the law, best first; the leading ones are gone into twice."""
        found: dict[str, Trial] = {}
        work, each = self.work, self.hands.each

        def keep(fits: Iterable[Fitted]) -> None:
            for trial in (self.judged(f) for f in fits if self._determined(f)):
                name = trial.names[0]
                if name not in found or trial.bic < found[name].bic:
                    found[name] = trial

        laws = [e for e in self.effects if e not in self._fitted]
        for fits in each(work.other_laws, laws, lambda x: report(0.1 * x)):
            keep(fits)
        names = [e.name for e in self._fitted]
        for name, state in zip(names, each(work.rough, names, lambda x: report(0.1 + 0.3 * x)), strict=True):
            work.learn(name, state)
            keep(f for known in state for f in known["near"])
        ahead = [best for name in self._ahead(found) for best in work.best_near(name)]
        keep(each(work.finished, ahead, lambda x: report(0.4 + 0.2 * x)))
        further = [(name, work.state(name)) for name in self._worth_more(found)]
        for fits in each(work.thorough, further, lambda x: report(0.6 + 0.3 * x)):
            keep(fits)
        places = [(name, work.state(name)) for name in self._misplaced(found)]
        for fits in each(work.everywhere, places, lambda x: report(0.9 + 0.1 * x)):
            keep(fits)
        return sorted(found.values(), key=lambda t: t.bic)

    def _determined(self, fitted: Fitted) -> bool:
        return fitted.parameters <= self.evidence.count - _SPARE

    def _ahead(self, found: Mapping[str, Trial]) -> list[str]:
        """Effects whose rough fit is among the best or not far behind."""
        order = sorted(found.values(), key=lambda t: t.fitted.chi2)
        names = {
            t.names[0]
            for place, t in enumerate(order)
            if place < 2 * LEADERS and t.fitted.chi2 < LEFT_BEHIND * order[0].fitted.chi2
        }
        return [e.name for e in self._fitted if e.name in names]

    def _worth_more(self, found: Mapping[str, Trial]) -> list[str]:
        """Effects that better starts might bring to the top, after a first pass."""
        order = sorted(found.values(), key=lambda t: t.bic)
        if not order or self.none.bic - order[0].bic < PROMISING:
            return []
        names = {t.names[0] for t in order if t.bic < order[0].bic + NEAR}
        best = order[0].fitted
        if not best.chi2_per_dof < UNCLEAR or any(e.replaces_law for e in best.effects):
            names |= {t.names[0] for t in order[:LEADERS]} | self._promising()
        return [e.name for e in self._fitted if e.name in names and e.unknowns]

    def _misplaced(self, found: Mapping[str, Trial]) -> list[str]:
        """Where all that lead lean, those of them whose right place may not have been among the first."""
        order = sorted(found.values(), key=lambda t: t.bic)
        if not order or self.none.bic - order[0].bic < PROMISING:
            return []
        effects = {e.name: e for e in self._fitted}
        leading = [t for t in order if t.bic < order[0].bic + NEAR and t.names[0] in effects]
        if not all(t.leans for t in leading):
            return []
        return [t.names[0] for t in leading if has_place(effects[t.names[0]])]

    def _promising(self) -> set[str]:
        """Where the law so far is no place to begin: the effects that do best from plain starts."""
        if not self.none.fitted.chi2_per_dof > WRONG:
            return set()
        return set(self.order_of_plain()[:LEADERS])

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
                fitted = min(fits, key=lambda f: self.judged(f).bic)
                continue
            priors = self.work.priors([*fitted.effects, effect])
            contenders = [
                Contender(self.task, self.evidence, fitted, form, priors) for form in effect.variants()
            ]
            fits = [c.finished(f) for c in contenders for f in [*c.near[:1], *c.far[:1]]]
            fitted = min(fits, key=lambda f: f.chi2)
        return self.judged(fitted)
