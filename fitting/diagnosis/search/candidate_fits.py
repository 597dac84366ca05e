"""Fits of one candidate, an effect or two, that need nothing of the others: any process can make them.

What the words mean here:

    form          one variant of an effect: its name and the variant's number
    start         the unknowns that a fit begins from
    rough fit     some steps from a start; it may be followed to its end, or dismissed
    wide valley   the same fit with readings taken for a few percent and stated numbers at their word: far
                  starts find their way there (`inference/wide_valley.py`)
    goal          chi-square that a rival must come down to, or it is given up
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.diagnosis.checks.prediction import held_out
from fitting.diagnosis.checks.predictive import temper
from fitting.diagnosis.checks.stretches import parts_held_out
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.freer_law import as_free_as_asked
from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.inference.refit import ROUGH, evaluated, refit
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.inference.usual_law import finished, followed, polished
from fitting.diagnosis.inference.wide_valley import in_wide_valley, of_effects, whole, with_stated
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.search.candidates import CandidateFit, Known, is_over_decades
from fitting.diagnosis.search.looks import Start, has_place, look
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.thresholds import SEARCH
from fitting.effects.base import Effect
from fitting.identification.validation import Validation
from fitting.laws import CoreLaw

A = TypeVar("A")
Form = tuple[str, int]
"""An effect by its name, and the number of its variant."""
State = list[Known]
"""What is known of each variant of an effect."""


@dataclass(frozen=True)
class FirstLook:
    """A first look at an effect: its rough fits, and what is known of its forms by them."""

    name: str
    fits: list[Refitted]
    state: State


class CandidateFits:
    """Fits of one set of data with one or two effects more than `none`."""

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
        name, number = form
        return self.candidates[name][number].effect

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

    def held_out(self, fitted: Refitted) -> Validation:
        """What a fit says of data it has not seen."""
        return held_out(self.problem, self.evidence, fitted, self.parts)

    @cached_property
    def parts(self) -> NDArray[np.intp]:
        """What is held out, the same of every fit. Shape (points,)."""
        return parts_held_out(self.problem, self.none.law)

    def other_laws(self, effect: Effect) -> list[Refitted]:
        """Fits with each of the laws that an effect has in the place of the stated one."""
        laws = effect.laws(self.none.law, self.problem.points)
        return self._best_laws(self.none, effect, laws)

    def other_laws_beside(self, one: tuple[Refitted, str, float]) -> list[Refitted]:
        """Fits with each of the laws of an effect beside a fit of another effect.

        None where the law that is freest to bend does not come down to `goal`.
        """
        before, name, goal = one
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
        nearest = min(rough, key=lambda f: f.chi2)
        if before.chi2 - nearest.chi2 > SEARCH.least_expected:
            further = effect.following(nearest.law, before.law, self.problem.points)
            rough += [refit(coarse, self.evidence, law, nearest.u, tolerance=ROUGH) for law in further]
        order = sorted(rough, key=lambda f: cost(f, self.problem.plate))
        worth = [f for f in order if f.chi2 < before.chi2]
        best = worth[: SEARCH.laws_finished] or order[:1]
        return [refit(response, self.evidence, f.law, f.u) for f in best]

    def starts(self, name: str) -> State:
        """What a first look at an effect promises."""
        for candidate in self.candidates[name]:
            _ = candidate.starts
        return self.state(name)

    def promise(self, name: str) -> float:
        """Chi-square that an effect may gain by one linear step."""
        return max((c.promise for c in self.candidates[name]), default=0.0)

    def begun(self, one: tuple[str, State]) -> "FirstLook":
        """An effect's rough fits near by, or its other laws in the place of the stated one."""
        name, state = one
        if self.effects[name].laws(self.none.law, self.problem.points):
            return FirstLook(name, self.other_laws(self.effects[name]), [])
        self.learn(name, state)
        fits = [f for candidate in self.candidates[name] for f in candidate.near]
        return FirstLook(name, fits, self.state(name))

    def beside_the_best(self, one: tuple[str, State, Refitted]) -> "FirstLook":
        """`begun` where another effect explains everything: from its law, if this one can do so there."""
        name, state, best = one
        if self.effects[name].laws(self.none.law, self.problem.points):
            return FirstLook(name, self.other_laws(self.effects[name]), [])
        self.learn(name, state)
        bare, there = self._from_the_law_of(best, [c.effect for c in self.candidates[name]])
        # From a law far off a linear step says nothing of a stiffness anywhere within six decades.
        astray = self.none.chi2_per_dof > SEARCH.wrong
        for candidate, from_there in zip(self.candidates[name], there, strict=True):
            able = from_there.is_open or from_there.promise > SEARCH.able * (bare.chi2 - best.chi2)
            near = [*candidate.briefly(), *(from_there.near if able else [])]
            placed = has_place(candidate.effect) and candidate.promise > SEARCH.able * (
                self.none.chi2 - best.chi2
            )
            if astray and (placed or is_over_decades(candidate.effect)):
                near += candidate.quick
            candidate.learn(Known(near=sorted(near, key=lambda f: f.chi2)))
        return FirstLook(name, [f for c in self.candidates[name] for f in c.near], self.state(name))

    def _from_the_law_of(
        self, best: Refitted, effects: Sequence[Effect]
    ) -> tuple[Refitted, list[CandidateFit]]:
        """A fit that explains everything with its effect taken away, and others as they begin there."""
        bare = evaluated(response_of(self.problem, ()), self.evidence, best.law, best.z)
        goal = self.goal(best)
        return bare, [CandidateFit(self.problem, self.evidence, bare, e, goal=goal) for e in effects]

    def another_form(self, one: tuple[Form, Refitted]) -> list[Refitted]:
        """Rough fits of a form from the law of another one of its effect that explains everything."""
        form, best = one
        _, (there,) = self._from_the_law_of(best, [self.form(form)])
        return there.near

    def plain(self, one: tuple[str, State]) -> State:
        """Fits of the first variant from plain starts."""
        name, state = one
        self.learn(name, state)
        _ = self.candidates[name][0].plain
        return self.state(name)

    def best_near(self, name: str) -> list[tuple[Form, Refitted]]:
        """The best of an effect's rough fits, or none; with it that of another form, if it is nearly as good.

        What two forms leave after some steps does not say which of them is the likelier in the end.
        """
        each = [((name, k), min(c.near, key=_chi2)) for k, c in enumerate(self.candidates[name]) if c.near]
        best = _best_first(each)
        return [one for one in best[: SEARCH.forms] if one[1].chi2 < best[0][1].chi2 + SEARCH.nearer]

    def on_the_way(self, name: str) -> list[tuple[Form, Refitted]]:
        """The best of an effect's rough fits that had not come to their end, or none."""
        fits = [((name, k), f) for k, c in enumerate(self.candidates[name]) for f in c.near]
        return sorted((one for one in fits if not one[1].converged), key=lambda one: one[1].chi2)[:1]

    def goal(self, best: Refitted) -> float:
        """Chi-square that a rival must come near to, where a fit explains everything there is."""
        if not self.evidence.scale_known:
            return np.inf
        return best.chi2 + SEARCH.near * temper(self.none, best)

    def finished(self, one: tuple[Form, Refitted, float]) -> Refitted:
        """A rough fit followed to the end, or to where a chi-square is out of reach."""
        (name, number), rough, goal = one
        return self.candidates[name][number].finished(rough, goal)

    def unfollowed(self, name: str, *, every: bool = False) -> list[tuple[Form, Start, float]]:
        """Further starts of an effect whose place is to be found, where nobody has followed them; or all.

        With the chi-square that they must come below to be among the best few of its rough fits.
        """
        rough = sorted(f.chi2 for c in self.candidates[name] for f in c.near)[: SEARCH.finished]
        rival = rough[-1] if len(rough) == SEARCH.finished else np.inf
        found = []
        for k, c in enumerate(self.candidates[name]):
            starts = [] if c.known.elsewhere is not None else [*c.further_starts]
            found += [((name, k), s, rival) for s in [*starts, *(c.last_starts if every else [])]]
        return found

    def set_out(self, one: tuple[Form, Start, float]) -> Refitted:
        """A fit that has gone a few steps from one start."""
        (name, number), start, _ = one
        return self.candidates[name][number].set_out(start)

    def gone_on(self, one: tuple[Form, Refitted, float]) -> Refitted:
        """What has set out, followed roughly; `rival` as `refit` takes it."""
        (name, number), begun, rival = one
        return self.candidates[name][number].gone_on(begun, rival)

    def far(self, one: tuple[Form, Known]) -> Known:
        """Rough fits of a form in wide valleys, and nothing else of it: the rest is known already."""
        (name, number), known = one
        candidate = self.candidates[name][number]
        candidate.learn(known)
        far = candidate.far
        return Known(plain=candidate.plain, far=far)

    def thorough(self, name: str, *, astray: bool) -> list[tuple[Form, Refitted]]:
        """The best of an effect's rough fits, but for those that have been followed to their end.

        With far ones, where the law so far is no place to begin.
        """
        forms = [((name, k), c) for k, c in enumerate(self.candidates[name])]
        gone = self.best_near(name)
        near = _best_first([(form, f) for form, c in forms for f in [*c.near, *c.elsewhere]])
        near = [one for one in near[: SEARCH.finished] if one not in gone]
        return [*near, *(self.from_stated(name) if astray else [])]

    def from_stated(self, name: str) -> list[tuple[Form, Refitted]]:
        """The best of an effect's fits in wide valleys, begun from what is stated."""
        forms = [((name, k), c) for k, c in enumerate(self.candidates[name])]
        return _best_first([(form, f) for form, c in forms for f in c.far])[: SEARCH.finished]

    def elsewhere(self, name: str) -> list[tuple[Form, Refitted]]:
        """Its rough fits from further starts, as far as they have been followed."""
        each = enumerate(self.candidates[name])
        return [((name, k), f) for k, c in each for f in c.known.elsewhere or ()]

    def look(self, one: tuple[Refitted, Sequence[Form]]) -> list[list[Start]]:
        """Starts of second effects beside a fit, a list for each."""
        return self._looks(one, self.evidence)

    def _looks(self, one: tuple[Refitted, Sequence[Form]], evidence: Evidence) -> list[list[Start]]:
        before, forms = one
        plain = response_of(self.problem, before.effects, self.problem.coarse)
        effects = [self.form(form) for form in forms]
        return [look(self.problem, evidence, before, e, again=True, plain=plain) for e in effects]

    def second(self, one: tuple[Refitted, Form, list[Start], float]) -> Refitted | None:
        """A second effect beside a fit, from the starts that a look has found; `goal` as `refit` takes it."""
        rough = self.near(one)
        return rough and self.ended((rough, one[3]))

    def near(self, one: tuple[Refitted, Form, list[Start], float]) -> Refitted | None:
        """A second effect beside a fit, followed roughly."""
        before, form, starts, goal = one
        effect = self.form(form)
        candidate = CandidateFit(self.problem, self.evidence, before, effect, starts, goal, one=True)
        return candidate.near[0] if candidate.near else None

    def alone(self, one: tuple[Refitted, Effect]) -> Refitted:
        """One effect of a pair as the pair has it, law and all, the other one taken away."""
        pair, effect = one
        response = response_of(self.problem, [effect])
        u = np.concatenate([pair.z, pair.of(effect)])
        return evaluated(response, self.evidence, pair.law, u)

    def look_wide(self, one: tuple[Refitted, Sequence[Form]]) -> list[list[Array]]:
        """Starts of second effects beside a fit in a wide valley, a list for each.

        By a linear step weighed as the readings are; where a place is to be found, as it is there too. Shape
        (parameters,) each.
        """
        before, forms = whole(self.problem, self.evidence, one[0]), one[1]
        found = [[u for _, u in starts[:1]] for starts in self._looks((before, forms), self.evidence)]
        placed = [k for k, form in enumerate(forms) if has_place(self.form(form))]
        there = self._looks((before, [forms[k] for k in placed]), self.evidence.blunt()) if placed else []
        for k, starts in zip(placed, there, strict=True):
            found[k] += [u for _, u in starts[:1] if not any(np.array_equal(u, one) for one in found[k])]
        return found

    def begun_wide(self, one: tuple[Refitted, Form, list[Array]]) -> list[Refitted]:
        """A second effect beside a fit in a wide valley: a few steps there from each start, best first.

        Shape (parameters,) of each start; none: its own first one.
        """
        before, form, starts = one
        effects = [*before.effects, self.form(form)]
        each = starts or effects[-1].starts(self.problem.plate, self.problem.points)[:1]
        known, law = of_effects(before), before.law
        begun = (np.concatenate([known, u]) for u in each)
        fits = [in_wide_valley(self.problem, effects, self.evidence, law, u, brief=True) for u in begun]
        return sorted(fits, key=lambda f: f.chi2)

    def wide(self, begun: Refitted) -> Refitted:
        """What has begun in a wide valley, followed roughly there."""
        u = of_effects(begun)
        return in_wide_valley(self.problem, begun.effects, self.evidence, begun.law, u)

    def left_in_wide_valley(self, fitted: Refitted) -> float:
        """Chi-square that a fit as the readings are comes to, followed in a wide valley."""
        return self.wide(fitted).chi2

    @property
    def noise_in_wide_valleys(self) -> float:
        """Chi-square that noise alone is expected to leave there."""
        share = (self.evidence.sigma_m_s / self.evidence.blunt().sigma_m_s) ** 2
        return float(np.sum(share)) * self.evidence.count / len(share)

    def briefly(self, wide: Refitted) -> Refitted:
        """What a wide valley has led to, a few steps on as the readings are."""
        return self._from(wide, brief=True)

    def roughly(self, brief: Refitted) -> Refitted:
        """What has gone a few steps, followed roughly as the readings are."""
        return self._from(brief)

    def _from(self, fitted: Refitted, *, brief: bool = False) -> Refitted:
        response = response_of(self.problem, fitted.effects, self.problem.coarse)
        u = with_stated(self.problem, fitted)
        return refit(response, self.evidence, fitted.law, u, tolerance=ROUGH, brief=brief)

    def ended(self, one: tuple[Refitted, float]) -> Refitted:
        """A rough fit followed to the end, or to where a chi-square is out of reach."""
        rough, goal = one
        if not rough.may_reach(goal):
            return rough
        return finished(self.problem, self.evidence, rough, goal)

    def fitted(self, one: tuple[Sequence[Effect], CoreLaw, Array]) -> Refitted:
        """Some effects fitted to the end, from a law and unknowns. Shape (unknowns,)."""
        effects, law, u = one
        return polished(self.problem, effects, self.evidence, law, u)

    def as_free_as_asked(self, fitted: Refitted) -> Refitted:
        """A fit with a law that bends as far as the data ask for."""

        def again(law: CoreLaw, begun: Refitted) -> Refitted:
            return self.fitted((begun.effects, law, begun.u))

        return as_free_as_asked(fitted, again, lambda one: cost(one, self.problem.plate))

    def follow_to_convergence(self, fitted: Refitted) -> Refitted:
        """A fit followed to its very end."""
        return followed(self.problem, self.evidence, fitted)


def _best_first(fits: list[tuple[A, Refitted]]) -> list[tuple[A, Refitted]]:
    return sorted(fits, key=lambda one: one[1].chi2)


def _chi2(fitted: Refitted) -> float:
    return fitted.chi2
