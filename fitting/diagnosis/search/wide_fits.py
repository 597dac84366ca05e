"""Second effects tried in wide valleys, beside one that is fitted there already (`inference/wide_valley.py`).

A pair begins there by a few steps (`begin_wide`) and is followed there (`follow_wide`); then it goes a few
steps as the readings are (`follow_briefly`), and is followed roughly (`follow_roughly`).
"""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import ROUGH, refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.inference.wide_valley import (
    evaluated_with_stated,
    in_wide_valley,
    of_effects,
    with_stated,
)
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.search.candidates import CandidateFit
from fitting.diagnosis.search.looks import Start, has_place, look
from fitting.diagnosis.search.tasks import Form
from fitting.diagnosis.several.responses import response_of
from fitting.effects.base import Effect


class WideFits:
    """The candidates of one set of data, and their fits in wide valleys.

    The base of `CandidateFits`, not beside it: another process is sent one object, once.
    """

    def __init__(
        self, problem: DiagnosisProblem, evidence: Evidence, none: Refitted, effects: Sequence[Effect]
    ) -> None:
        self.problem, self.evidence, self.none = problem, evidence, none
        self.effects = {e.name: e for e in effects}
        self.candidates = {
            e.name: [
                CandidateFit(problem, evidence, none, form) for form in e.forms(problem.points, problem.plate)
            ]
            for e in effects
        }

    def form(self, form: Form) -> Effect:
        """The effect that a form stands for."""
        return self.candidate(form).effect

    def candidate(self, form: Form) -> CandidateFit:
        """What is known of a form, and what can be done for it."""
        name, number = form
        return self.candidates[name][number]

    def look_by(self, before: Refitted, forms: Sequence[Form], evidence: Evidence) -> list[list[Start]]:
        """Starts of second effects beside a fit by some evidence, a list for each."""
        plain = response_of(self.problem, before.effects, self.problem.coarse)
        effects = [self.form(form) for form in forms]
        return [look(self.problem, evidence, before, e, again=True, plain=plain) for e in effects]

    def look_wide(self, before: Refitted, forms: Sequence[Form]) -> list[list[Array]]:
        """Starts of second effects beside a fit in a wide valley, a list for each.

        By a linear step weighed as the readings are; where a place is to be found, as it is there too. Shape
        (parameters,) each.
        """
        there = evaluated_with_stated(self.problem, self.evidence, before)
        found = [[u for _, u in starts[:1]] for starts in self.look_by(there, forms, self.evidence)]
        placed = [k for k, form in enumerate(forms) if has_place(self.form(form))]
        again = [forms[k] for k in placed]
        blunt = self.look_by(there, again, self.evidence.blunt()) if placed else []
        for k, starts in zip(placed, blunt, strict=True):
            found[k] += [u for _, u in starts[:1] if not any(np.array_equal(u, one) for one in found[k])]
        return found

    def begin_wide(self, before: Refitted, form: Form, starts: Sequence[Array]) -> list[Refitted]:
        """A second effect beside a fit in a wide valley: a few steps there from each start, best first.

        Without starts from its own first one. Shape of a start (parameters,).
        """
        effects = [*before.effects, self.form(form)]
        each = starts or effects[-1].starts(self.problem.plate, self.problem.points)[:1]
        known, law = of_effects(before), before.law
        begun = (np.concatenate([known, u]) for u in each)
        fits = [in_wide_valley(self.problem, effects, self.evidence, law, u, brief=True) for u in begun]
        return sorted(fits, key=by_chi2)

    def follow_wide(self, begun: Refitted) -> Refitted:
        """What has begun in a wide valley, followed roughly there."""
        u = of_effects(begun)
        return in_wide_valley(self.problem, begun.effects, self.evidence, begun.law, u)

    def left_in_wide_valley(self, fitted: Refitted) -> float:
        """Chi-square that a fit as the readings are comes to, followed in a wide valley."""
        return self.follow_wide(fitted).chi2

    @property
    def noise_in_wide_valleys(self) -> float:
        """Chi-square that noise alone is expected to leave there."""
        share = (self.evidence.sigma_m_s / self.evidence.blunt().sigma_m_s) ** 2
        return float(np.sum(share)) * self.evidence.count / len(share)

    def follow_briefly(self, wide: Refitted) -> Refitted:
        """What a wide valley has led to, a few steps on as the readings are."""
        return self._followed(wide, brief=True)

    def follow_roughly(self, brief: Refitted) -> Refitted:
        """What has gone a few steps, followed roughly as the readings are."""
        return self._followed(brief)

    def _followed(self, fitted: Refitted, *, brief: bool = False) -> Refitted:
        response = response_of(self.problem, fitted.effects, self.problem.coarse)
        u = with_stated(self.problem, fitted)
        return refit(response, self.evidence, fitted.law, u, tolerance=ROUGH, brief=brief)
