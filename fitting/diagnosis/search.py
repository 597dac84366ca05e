"""The catalogue tried on a residual: single effects, other laws, pairs where one does not suffice."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.diagnosis.candidates import WRONG, blunt_chi2, fit_with, look
from fitting.diagnosis.evidence import Evidence
from fitting.diagnosis.refit import Fitted, refit
from fitting.diagnosis.task import Task
from fitting.effects.base import Effect
from fitting.properties import PROPERTIES

Array = NDArray[np.float64]
Report = Callable[[float], None]

NEAR = 40.0
"""In BIC, above the best: effects so near are gone into twice."""
UNCLEAR = 1.1
"""Chi-square per degree of freedom above which the first pass may have missed the cause."""
PROMISING = 5.0
"""In BIC, over none: below it nothing is gone into twice."""
LEADERS = 5
"""Single effects that a second one is looked for beside."""
PAIRS = 12
_SPARE = 2
"""Data a candidate must leave over."""
"""Pairs fitted in full."""


PAIRS_A_LEADER = 4
LEAST_EXPECTED = 15.0
"""Chi-square that a second effect must promise where the first leaves little."""


@dataclass(frozen=True, eq=False)
class Trial:
    """A fitted candidate and its evidence: chi-square with every parameter paid for (BIC)."""

    fitted: Fitted
    bic: float

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects; empty for none."""
        return tuple(e.name for e in self.fitted.effects)


class Search:
    """Fits of one set of data."""

    def __init__(self, task: Task, evidence: Evidence, none: Fitted, effects: Sequence[Effect]) -> None:
        self.task, self.evidence = task, evidence
        self.stated = none.law
        self.none = self._judged(none)
        self.effects = [e for e in effects if e.objection(task.points, task.plate) is None]

    def _judged(self, fitted: Fitted) -> Trial:
        n = self.evidence.count + (len(self.evidence.bare.shift) if self.evidence.bare else 0)
        parameters = fitted.parameters
        if any(e.replaces_law for e in fitted.effects):
            # One of many laws: choosing is a parameter too, and none counts less than the stated one.
            parameters = max(parameters, len(self.stated.names)) + 2
        paid = parameters * np.log(n)
        if self.evidence.scale_known:
            return Trial(fitted, fitted.chi2 + paid)
        # Noise of unknown size: its estimate is in the likelihood.
        return Trial(fitted, n * np.log(max(fitted.chi2, 1e-300) / n) + paid)

    def priors(self, effects: Sequence[Effect]) -> Array:
        """Standard deviations of unknowns about their neutral values: the specimen's tolerances."""
        stated = self.task.specimen.tolerances
        found = {f"{name}": stated[name] for name in PROPERTIES if name in stated}
        return np.array([found.get(e.tolerance or "", np.inf) for e in effects for _ in e.unknowns])

    def singles(self, report: Report) -> list[Trial]:
        """Every effect beside the law, best first; the leading ones are gone into twice."""
        found: dict[str, Trial] = {}
        for thorough in (False, True):
            wanted = self._worth_more(found) if thorough else self.effects
            with ThreadPoolExecutor(2) as pool:
                fits = pool.map(lambda e, thorough=thorough: self._alone(e, thorough=thorough), wanted)
                for done, (effect, fitted) in enumerate(zip(wanted, fits, strict=True)):
                    if fitted is not None:
                        trial = self._judged(fitted)
                        if effect.name not in found or trial.bic < found[effect.name].bic:
                            found[effect.name] = trial
                    report((0.6 if not thorough else 0.4) * (done + 1) / len(wanted) + 0.6 * thorough)
        return sorted(found.values(), key=lambda t: t.bic)

    def _worth_more(self, found: dict[str, Trial]) -> list[Effect]:
        """Effects that better starts might bring to the top, after a first pass."""
        order = sorted(found.values(), key=lambda t: t.bic)
        if not order or self.none.bic - order[0].bic < PROMISING:
            return []
        names = {t.names[0] for t in order if t.bic < order[0].bic + NEAR}
        best = order[0].fitted
        if not best.chi2_per_dof < UNCLEAR or any(e.replaces_law for e in best.effects):
            names |= {t.names[0] for t in order[:LEADERS]} | self._promising()
        return [e for e in self.effects if e.name in names and not e.replaces_law and e.unknowns]

    def _promising(self) -> set[str]:
        """Where the law so far is no place to begin: the effects that do best from plain starts."""
        none = self.none.fitted
        if not none.chi2_per_dof > WRONG:
            return set()
        fitted = [e for e in self.effects if not e.replaces_law and e.unknowns]
        with ThreadPoolExecutor(2) as pool:
            chi2 = list(
                pool.map(lambda e: blunt_chi2(self.task, self.evidence, none, e, self.priors([e])), fitted)
            )
        return {fitted[k].name for k in np.argsort(chi2)[:LEADERS]}

    def _alone(self, effect: Effect, *, thorough: bool) -> Fitted | None:
        fits = [f for form in effect.variants() for f in self._form(form, thorough=thorough)]
        fits = [f for f in fits if f.parameters <= self.evidence.count - _SPARE]
        return min(fits, key=lambda f: f.chi2) if fits else None

    def _form(self, effect: Effect, *, thorough: bool) -> list[Fitted]:
        none = self.none.fitted
        laws = effect.laws(none.law, self.task.points)
        if laws:
            response = none.response.beside(effect)
            fits = [refit(response, self.evidence, law, none.u) for law in laws]
            return [min(fits, key=lambda f: self._judged(f).bic)]
        priors = self.priors([effect])
        fitted = fit_with(self.task, self.evidence, none, effect, priors, thorough=thorough)
        return [fitted] if fitted is not None else []

    def pairs(self, singles: Sequence[Trial], report: Report, *, wide: bool) -> list[Trial]:
        """Second effects beside the leading single ones, or the first alone; best first."""
        leaders = list(singles[: LEADERS if wide else 1])
        tasks = [
            (t, form)
            for t in leaders
            for e in self.effects
            if e.name not in t.names and not e.replaces_law
            for form in e.variants()
        ]

        def first_look(pair: tuple[Trial, Effect]) -> list[tuple[float, Array]]:
            return look(self.task, self.evidence, pair[0].fitted, pair[1])

        with ThreadPoolExecutor(2) as pool:
            looks = list(pool.map(first_look, tasks))
            report(0.4)
            expected = [
                t.fitted.chi2 - starts[0][0] if starts else np.inf
                for (t, _), starts in zip(tasks, looks, strict=True)
            ]
            chosen: dict[frozenset[str], int] = {}
            beside: dict[Trial, int] = {}
            enough = singles[0].fitted.chi2 - LEAST_EXPECTED
            for k in np.argsort(expected):
                trial, effect = tasks[k]
                # Each leader has its say: a linear step from a poor one promises too much.
                many = len(chosen) == PAIRS or beside.get(trial, 0) == PAIRS_A_LEADER
                if not many and (wide or expected[k] < enough):
                    beside[trial] = beside.get(trial, 0) + 1
                    chosen.setdefault(frozenset((*trial.names, effect.name)), int(k))

            def full(k: int) -> Fitted | None:
                trial, effect = tasks[k]
                priors = self.priors([*trial.fitted.effects, effect])
                return fit_with(self.task, self.evidence, trial.fitted, effect, priors, looks[k])

            fits = [f for f in pool.map(full, chosen.values()) if f is not None]
        report(1.0)
        return sorted((self._judged(f) for f in fits), key=lambda t: t.bic)
