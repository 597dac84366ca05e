"""Fits of one candidate, an effect or two, that need nothing of the others: any process can make them.

What the words mean here:

    form          one variant of an effect: its name and the variant's number
    start         the unknowns that a fit begins from
    rough fit     some steps from a start; it may be followed to its end, or dismissed
    wide valley   a rough fit with the noise raised to 3 % of every reading and stated numbers held as stated,
                  so that distant starts converge (`inference/wide_valley.py`)
    goal          chi-square that a rival must come down to, or it is given up
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.diagnosis.checks.prediction import held_out
from fitting.diagnosis.checks.predictive import temper
from fitting.diagnosis.checks.stretches import parts_held_out
from fitting.diagnosis.inference.freer_law import as_free_as_asked
from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.inference.refit import ROUGH, evaluated, refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.inference.usual_law import finished, followed, polished
from fitting.diagnosis.search.candidates import CandidateFit, CandidateState, is_over_decades
from fitting.diagnosis.search.looks import Start, has_place
from fitting.diagnosis.search.tasks import Form, FormFit, FormStart, State
from fitting.diagnosis.search.wide_fits import WideFits
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.thresholds import PAIRS, STARTS, STOPPING
from fitting.effects.base import Effect
from fitting.identification.validation import Validation
from fitting.laws import CoreLaw


@dataclass(frozen=True)
class FirstLook:
    """A first look at an effect: its rough fits, and what is known of its forms by them."""

    name: str
    fits: list[Refitted]
    state: State


class CandidateFits(WideFits):
    """Fits of one set of data with one or two effects more than `none`."""

    def has_places(self, name: str) -> bool:
        """Whether an effect has a form whose place is to be found."""
        return any(has_place(c.effect) for c in self.candidates[name])

    def state(self, name: str) -> State:
        """What is known of an effect so far."""
        return [c.known for c in self.candidates[name]]

    def learn(self, name: str, state: State) -> None:
        """Take over what another process has found of an effect."""
        for candidate, known in zip(self.candidates[name], state, strict=True):
            candidate.learn(known)

    def predict_held_out(self, fitted: Refitted) -> Validation:
        """What a fit says of data it has not seen."""
        return held_out(self.problem, self.evidence, fitted, self.parts)

    @cached_property
    def parts(self) -> NDArray[np.intp]:
        """What is held out, the same of every fit. Shape (points,)."""
        return parts_held_out(self.problem, self.none.law)

    def fit_other_laws(self, effect: Effect) -> list[Refitted]:
        """Fits with each of the laws that an effect has in the place of the stated one."""
        laws = effect.laws(self.none.law, self.problem.points)
        return self._best_laws(self.none, effect, laws)

    def fit_other_laws_beside(self, before: Refitted, name: str, goal: float) -> list[Refitted]:
        """Fits with each of the laws of an effect beside a fit of another effect.

        None where the law that is freest to bend does not come down to `goal`.
        """
        effect = self.effects[name]
        laws = effect.laws(before.law, self.problem.points)
        freest = max(laws, key=lambda law: len(law.names))
        coarse = response_of(self.problem, [*before.effects, effect], self.problem.coarse)
        rough = refit(coarse, self.evidence, freest, before.u, tolerance=ROUGH, goal=goal)
        if rough.chi2 >= goal:
            return []
        return self._best_laws(before, effect, [law for law in laws if law is not freest], [rough])

    def _best_laws(
        self,
        before: Refitted,
        effect: Effect,
        laws: Sequence[CoreLaw],
        begun: Sequence[Refitted] = (),
    ) -> list[Refitted]:
        """The best of some laws, fitted to the end; those in `begun` have been fitted roughly."""
        response = response_of(self.problem, [*before.effects, effect])
        coarse = response_of(self.problem, [*before.effects, effect], self.problem.coarse)
        rough = [refit(coarse, self.evidence, law, before.u, tolerance=ROUGH) for law in laws]
        rough += begun
        nearest = min(rough, key=by_chi2)
        if before.chi2 - nearest.chi2 > PAIRS.least_promise:
            further = effect.following(nearest.law, before.law, self.problem.points)
            rough += [refit(coarse, self.evidence, law, nearest.u, tolerance=ROUGH) for law in further]
        order = sorted(rough, key=lambda f: cost(f, self.problem.plate))
        worth = [f for f in order if f.chi2 < before.chi2]
        best = worth[: STARTS.laws_finished] or order[:1]
        return [refit(response, self.evidence, f.law, f.u) for f in best]

    def look_first(self, name: str) -> State:
        """What a first look at an effect promises."""
        for candidate in self.candidates[name]:
            candidate.find_starts()
        return self.state(name)

    def promise(self, name: str) -> float:
        """Chi-square that an effect may gain by one linear step."""
        return max((c.promise() for c in self.candidates[name]), default=0.0)

    def begin(self, name: str, state: State) -> FirstLook:
        """An effect's rough fits near by, or its other laws in the place of the stated one."""
        if self.effects[name].laws(self.none.law, self.problem.points):
            return FirstLook(name, self.fit_other_laws(self.effects[name]), [])
        self.learn(name, state)
        fits = [f for candidate in self.candidates[name] for f in candidate.fit_near()]
        return FirstLook(name, fits, self.state(name))

    def begin_beside_the_best(self, name: str, state: State, best: Refitted) -> FirstLook:
        """`begin` where another effect explains everything: from its law, if this one can do so there."""
        if self.effects[name].laws(self.none.law, self.problem.points):
            return FirstLook(name, self.fit_other_laws(self.effects[name]), [])
        self.learn(name, state)
        bare, there = self._from_the_law_of(best, [c.effect for c in self.candidates[name]])
        # From a law far off a linear step says nothing of a stiffness anywhere within six decades.
        astray = self.none.chi2_per_dof > STOPPING.wrong_law_chi2_per_dof
        share = STARTS.least_share_of_best_gain
        for candidate, from_there in zip(self.candidates[name], there, strict=True):
            able = from_there.is_open() or from_there.promise() > share * (bare.chi2 - best.chi2)
            near = [*candidate.briefly(), *(from_there.fit_near() if able else [])]
            placed = has_place(candidate.effect) and candidate.promise() > share * (
                self.none.chi2 - best.chi2
            )
            if astray and (placed or is_over_decades(candidate.effect)):
                near += candidate.fit_quickly()
            candidate.learn(CandidateState(near=sorted(near, key=by_chi2)))
        return FirstLook(name, [f for c in self.candidates[name] for f in c.fit_near()], self.state(name))

    def _from_the_law_of(
        self, best: Refitted, effects: Sequence[Effect]
    ) -> tuple[Refitted, list[CandidateFit]]:
        """A fit that explains everything with its effect taken away, and others as they begin there."""
        bare = evaluated(response_of(self.problem, ()), self.evidence, best.law, best.z)
        goal = self.goal(best)
        return bare, [CandidateFit(self.problem, self.evidence, bare, e, goal=goal) for e in effects]

    def fit_another_form(self, form: Form, best: Refitted) -> list[Refitted]:
        """Rough fits of a form from the law of another one of its effect that explains everything."""
        _, (there,) = self._from_the_law_of(best, [self.form(form)])
        return there.fit_near()

    def fit_plain(self, name: str, state: State) -> State:
        """Fits of the first variant from plain starts."""
        self.learn(name, state)
        self.candidates[name][0].fit_plain()
        return self.state(name)

    def best_near(self, name: str) -> list[FormFit]:
        """The best of an effect's rough fits, or none; with it that of another form, if it is nearly as good.

        What two forms leave after some steps does not say which of them is the likelier in the end.
        """
        forms = enumerate(self.candidates[name])
        each = [FormFit((name, k), min(c.fit_near(), key=by_chi2)) for k, c in forms if c.fit_near()]
        best = _best_first(each)
        return [
            one
            for one in best[: STARTS.forms]
            if one[1].chi2 < best[0][1].chi2 + STOPPING.cost_near_best_settled
        ]

    def on_the_way(self, name: str) -> list[FormFit]:
        """The best of an effect's rough fits that had not come to their end, or none."""
        fits = [FormFit((name, k), f) for k, c in enumerate(self.candidates[name]) for f in c.fit_near()]
        return _best_first([one for one in fits if not one.fitted.converged])[:1]

    def goal(self, best: Refitted) -> float:
        """Chi-square that a rival must come near to, where a fit explains everything there is."""
        if not self.evidence.scale_known:
            return np.inf
        return best.chi2 + STOPPING.cost_near_best * temper(self.none, best)

    def finish(self, form: Form, rough: Refitted, goal: float) -> Refitted:
        """A rough fit followed to the end, or to where a chi-square is out of reach."""
        return self.candidate(form).finished(rough, goal)

    def unfollowed(self, name: str, *, every: bool = False) -> list[FormStart]:
        """Further starts of an effect whose place is to be found, where nobody has followed them; or all.

        With the chi-square that they must come below to be among the best few of its rough fits.
        """
        rough = sorted(f.chi2 for c in self.candidates[name] for f in c.fit_near())[: STARTS.finished]
        rival = rough[-1] if len(rough) == STARTS.finished else np.inf
        found = []
        for k, c in enumerate(self.candidates[name]):
            starts = [] if c.known.elsewhere is not None else [*c.further_starts()]
            found += [FormStart((name, k), s, rival) for s in [*starts, *(c.last_starts() if every else [])]]
        return found

    def set_out(self, form: Form, start: Start) -> Refitted:
        """A fit that has gone a few steps from one start."""
        return self.candidate(form).set_out(start)

    def go_on(self, form: Form, begun: Refitted, rival: float) -> Refitted:
        """What has set out, followed roughly; `rival` as `refit` takes it."""
        return self.candidate(form).gone_on(begun, rival)

    def fit_far(self, form: Form, known: CandidateState) -> CandidateState:
        """Rough fits of a form in wide valleys, and nothing else of it: the rest is known already."""
        candidate = self.candidate(form)
        candidate.learn(known)
        far = candidate.fit_far()
        return CandidateState(plain=candidate.fit_plain(), far=far)

    def thorough(self, name: str, *, astray: bool) -> list[FormFit]:
        """The best of an effect's rough fits, but for those that have been followed to their end.

        With far ones, where the law so far is no place to begin.
        """
        forms = [((name, k), c) for k, c in enumerate(self.candidates[name])]
        gone = self.best_near(name)
        near = _best_first(
            [FormFit(form, f) for form, c in forms for f in [*c.fit_near(), *c.fit_elsewhere()]]
        )
        near = [one for one in near[: STARTS.finished] if one not in gone]
        return [*near, *(self.from_stated(name) if astray else [])]

    def from_stated(self, name: str) -> list[FormFit]:
        """The best of an effect's fits in wide valleys, begun from what is stated."""
        forms = [((name, k), c) for k, c in enumerate(self.candidates[name])]
        return _best_first([FormFit(form, f) for form, c in forms for f in c.fit_far()])[: STARTS.finished]

    def elsewhere(self, name: str) -> list[FormFit]:
        """Its rough fits from further starts, as far as they have been followed."""
        each = enumerate(self.candidates[name])
        return [FormFit((name, k), f) for k, c in each for f in c.known.elsewhere or ()]

    def look(self, before: Refitted, forms: Sequence[Form]) -> list[list[Start]]:
        """Starts of second effects beside a fit, a list for each."""
        return self.look_by(before, forms, self.evidence)

    def fit_second(
        self, before: Refitted, form: Form, starts: Sequence[Start], goal: float
    ) -> Refitted | None:
        """A second effect beside a fit, from the starts that a look has found; `goal` as `refit` takes it."""
        rough = self.fit_second_roughly(before, form, starts, goal)
        return rough and self.follow_to_end(rough, goal)

    def fit_second_roughly(
        self, before: Refitted, form: Form, starts: Sequence[Start], goal: float
    ) -> Refitted | None:
        """A second effect beside a fit, followed roughly."""
        effect = self.form(form)
        candidate = CandidateFit(self.problem, self.evidence, before, effect, starts, goal, one=True)
        return next(iter(candidate.fit_near()), None)

    def evaluate_alone(self, pair: Refitted, effect: Effect) -> Refitted:
        """One effect of a pair as the pair has it, law and all, the other one taken away."""
        response = response_of(self.problem, [effect])
        u = np.concatenate([pair.z, pair.of(effect)])
        return evaluated(response, self.evidence, pair.law, u)

    def follow_to_end(self, rough: Refitted, goal: float) -> Refitted:
        """A rough fit followed to the end, or to where a chi-square is out of reach."""
        if not rough.may_reach(goal):
            return rough
        return finished(self.problem, self.evidence, rough, goal)

    def fit(self, effects: Sequence[Effect], law: CoreLaw, u: Array) -> Refitted:
        """Some effects fitted to the end, from a law and unknowns. Shape of `u` as in `Refitted`."""
        return polished(self.problem, effects, self.evidence, law, u)

    def loosen_as_asked(self, fitted: Refitted) -> Refitted:
        """A fit with a law that bends as far as the data ask for."""

        def again(law: CoreLaw, begun: Refitted) -> Refitted:
            return self.fit(begun.effects, law, begun.u)

        return as_free_as_asked(fitted, again, lambda one: cost(one, self.problem.plate))

    def follow_to_convergence(self, fitted: Refitted) -> Refitted:
        """A fit followed to its very end."""
        return followed(self.problem, self.evidence, fitted)


def _best_first(fits: list[FormFit]) -> list[FormFit]:
    return sorted(fits, key=lambda one: one.fitted.chi2)
