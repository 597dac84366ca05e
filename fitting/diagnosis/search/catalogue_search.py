"""The catalogue tried on a residual, effect by effect."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from fitting.diagnosis.checks.prediction import over_noise
from fitting.diagnosis.checks.predictive import TOLERANCES, checks, form_error, most_unrefused, passes, temper
from fitting.diagnosis.executor import Call, Executor
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.freer_law import freedom_of
from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.inference.refit import refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.search.candidate_fits import CandidateFits
from fitting.diagnosis.search.candidates import CandidateFit
from fitting.diagnosis.search.looks import has_place, look
from fitting.diagnosis.search.stand_in import stands_in, too_large, unsized
from fitting.diagnosis.search.tasks import FromLaw
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.thresholds import PAIRS, STARTS, STOPPING, VERDICT
from fitting.effects.base import Effect
from fitting.identification.validation import Validation

_SPARE = 2
"""Data a candidate must leave over."""


@dataclass(frozen=True, eq=False)
class ScoredFit:
    """A fitted explanation, what it is worth, and what speaks against it."""

    fitted: Refitted
    cost: float
    """-2 ln of prior times marginal likelihood (`marginal`)."""
    checks: Mapping[str, float] = field(default_factory=dict)
    """Tail probabilities of posterior predictive checks (`predictive`)."""

    stands_in: str = ""
    """Why it may stand in for a cause that is in no catalogue (`stand_in`); empty where it does not."""
    too_large: str = ""
    """Which effect would be larger than is plausible; empty where none would."""
    unsized: bool = False
    """Whether one of two effects has no size that the data tell from nothing (`stand_in`)."""

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects; empty for none."""
        return tuple(e.name for e in self.fitted.effects)

    @property
    def fails(self) -> bool:
        """Whether such data are not what it would leave."""
        return not passes(self.checks)

    @property
    def past_help(self) -> bool:
        """Whether it is refused so plainly that no further steps of its fit will mend it."""
        return any(p < STOPPING.past_help for p in self.checks.values())

    @property
    def strains(self) -> float | None:
        """How improbable it is that the stated numbers are where it has them; None where that is no doubt."""
        p = self.checks.get(TOLERANCES, 1.0)
        return p if p < VERDICT.doubted else None


def by_cost(scored: ScoredFit) -> float:
    """Order of explanations: the likeliest comes first."""
    return scored.cost


def best_of_each(scored_fits: Sequence[ScoredFit]) -> list[ScoredFit]:
    """The cheapest fit of each set of effects, best first."""
    best: dict[frozenset[str], ScoredFit] = {}
    for scored in sorted(scored_fits, key=by_cost):
        best.setdefault(frozenset(scored.names), scored)
    return list(best.values())


class Search:
    """Fits of one set of data, and what each is worth.

    A fit's own cost is the same whenever it is judged. What a difference of costs says (`temper`, and all
    that asks it) rests on the least chi-square that each of two effects has left by itself so far, which
    `judged` keeps: single effects are judged before pairs, and what is found of them later counts too.
    """

    def __init__(
        self,
        problem: DiagnosisProblem,
        evidence: Evidence,
        none: Refitted,
        effects: Sequence[Effect],
        executor: Executor,
    ) -> None:
        self.problem, self.evidence, self.executor = problem, evidence, executor
        self.stated = stated = none.law
        self._validations: dict[Refitted, Validation] = {}
        self.effects = [e for e in effects if e.objection(problem.points, problem.plate) is None]
        self.objected = tuple(e for e in effects if e not in self.effects)
        """Effects that were asked for, and that these data cannot carry."""
        self.passing_for_a_law = tuple(e.name for e in effects if e.passes_for_a_law(problem.points))
        """Effects that these data would show as another law."""
        fitted = [e for e in self.effects if not e.laws(stated, problem.points)]
        # The longest first, so that all worker processes end together.
        self.beside_the_law = sorted(fitted, key=has_place, reverse=True)
        self.work = CandidateFits(problem, evidence, none, self.effects)
        self._none = none
        self._ends: dict[Refitted, Refitted] = {}
        """Fits followed to their very end."""
        self._alone: dict[str, float] = {}
        """Least chi-square of each effect by itself."""
        self.none = self.judged(none)

    def with_evidence(self, evidence: Evidence) -> "Search":
        """The same search with other evidence: of the same readings with another noise."""
        none = self.none.fitted
        again = refit(response_of(self.problem, ()), evidence, none.law, none.u)
        search = Search(self.problem, evidence, again, self.effects, self.executor)
        search.objected = self.objected
        return search

    def judged(self, fitted: Refitted) -> ScoredFit:
        """A fit with what it is worth. One of a single effect counts in `temper` from now on."""
        struck = self.problem.points.struck
        found = checks(self.problem.sweep, self.evidence, self._none, fitted, struck)
        doubt = stands_in(self.problem, fitted)
        self._keep_alone(fitted)
        large = too_large(fitted, self.problem.plate)
        return ScoredFit(fitted, self._cost(fitted), found, doubt, large, unsized(fitted))

    def _keep_alone(self, fitted: Refitted) -> None:
        """Of a single effect, the least that it has left so far."""
        if len(fitted.effects) == 1:
            name = fitted.effects[0].name
            self._alone[name] = min(fitted.chi2, self._alone.get(name, np.inf))

    def _cost(self, fitted: Refitted, temper: float = 1.0) -> float:
        """`marginal.cost`, and a penalty for each doubling of how far the law may bend: few materials do."""
        doublings = np.log2(freedom_of(fitted.law) / freedom_of(self.stated))
        return cost(fitted, self.problem.plate, temper) + VERDICT.freer_law_cost * float(doublings)

    def tempered(self, scored_fits: Sequence[ScoredFit]) -> tuple[ScoredFit, list[ScoredFit]]:
        """None and the others with what they are worth where the best explains far more than noise."""
        t = self.temper_of(scored_fits)
        none, *others = (replace(one, cost=self._cost(one.fitted, t)) for one in (self.none, *scored_fits))
        return none, others

    def temper_of(self, scored_fits: Sequence[ScoredFit]) -> float:
        """`temper` by the best of them, or by none."""
        return self.temper(min([self.none, *scored_fits], key=by_cost))

    def temper(self, best: ScoredFit) -> float:
        """How much less a difference of costs says, where the best explains far more than noise."""
        return temper(self._none, best.fitted, self._alone) if self.evidence.scale_known else 1.0

    def allowed(self, scored: ScoredFit) -> float:
        """Chi-square per degree of freedom that the formulas of an explanation's effects may leave."""
        dof = max(1, scored.fitted.data - scored.fitted.parameter_count)
        return 1 + form_error(self._none, scored.fitted, self._alone) / dof

    def left_by(self, scored: ScoredFit) -> float:
        """Chi-square per degree of freedom over what is `allowed`."""
        return scored.fitted.chi2_per_dof / self.allowed(scored)

    def suffices(self, scored: ScoredFit) -> bool:
        """Whether it leaves what noise leaves, fails no check, and its law is of the stated kind."""
        flexible = any(e.replaces_law for e in scored.fitted.effects)
        return not (flexible or scored.fails or self.left_by(scored) > PAIRS.one_suffices_chi2_per_dof)

    def unrefused(self, effects: Sequence[Effect]) -> float:
        """Chi-square that these effects must come down to, for no check to refuse what they leave or ask."""
        return most_unrefused(self._none, effects)

    def validate(self, scored_fits: Sequence[ScoredFit]) -> None:
        """Validations to come, side by side."""
        new = self._not_validated(scored_fits)
        self._learn_validations(new, self.executor.map(self.work.predict_held_out, [t.fitted for t in new]))

    def _not_validated(self, scored_fits: Sequence[ScoredFit]) -> list[ScoredFit]:
        return [t for t in scored_fits if t.fitted not in self._validations]

    def _learn_validations(self, scored_fits: Sequence[ScoredFit], said: Iterable[Validation]) -> None:
        self._validations |= {t.fitted: v for t, v in zip(scored_fits, said, strict=True)}

    def validation(self, scored: ScoredFit) -> Validation:
        """What an explanation says of data it has not seen."""
        if scored.fitted not in self._validations:
            self._validations[scored.fitted] = self.work.predict_held_out(scored.fitted)
        return self._validations[scored.fitted]

    def off_unseen(self, scored: ScoredFit) -> float:
        """Its error over noise on segments that were held out; NaN where there are none.

        Stretches of a sweep in one piece touch: of them two effects foretell more than is theirs.
        """
        if len(np.unique(self.problem.sweep.segment)) < 2:
            return float("nan")
        return over_noise(self.validation(scored))

    def alone(self, scored: ScoredFit) -> list[ScoredFit]:
        """Each effect of a pair fitted alone from where the pair left it."""
        pair = scored.fitted
        if any(e.replaces_law for e in pair.effects):
            return []
        begun = [FromLaw([e], pair.law, np.concatenate([pair.z, pair.of(e)])) for e in pair.effects]
        return [self.judged(f) for f in self.executor.starmap(self.work.fit, begun)]

    def converged_group(
        self, scored_fits: Sequence[ScoredFit], best: ScoredFit, validated: Sequence[ScoredFit] = ()
    ) -> list[ScoredFit]:
        """Explanations that may be in one group with `best`, and none, converged; the others as they are.

        Fits that are to be `validated` are so in the same batch of work.
        """
        moving, new = self.moving([self.none, *scored_fits], best), self._not_validated(validated)
        calls: list[Call] = [(self.work.follow_to_convergence, (fitted,)) for fitted in moving]
        calls += [(self.work.predict_held_out, (t.fitted,)) for t in new]
        found = list(self.executor.together(calls))
        self.keep_converged(moving, found[: len(moving)])
        self._learn_validations(new, found[len(moving) :])
        end = self._at_its_end(self.none)
        if self.none.fitted.chi2 - end.fitted.chi2 > STOPPING.least_owed:
            self.none = end
        return [self._at_its_end(t) for t in scored_fits]

    def leading(self, singles: Sequence[ScoredFit], scale: float = 1.0) -> list[ScoredFit]:
        """The best of some, and those near it that are worth more than no effect.

        One that is worth no more starts only pairs that its partner starts as well.
        """
        if not singles:
            return []
        best, *others = singles
        below = min(best.cost + STOPPING.cost_near_best * scale, self.none.cost)
        return [best, *(t for t in others if t.cost < below)]

    def reach(self, best: ScoredFit) -> float:
        """Cost up to which others may be in one group with it."""
        return best.cost + STOPPING.reported_cost * self.temper(best)

    def moving(self, scored_fits: Sequence[ScoredFit], best: ScoredFit) -> list[Refitted]:
        """What may be in one group with `best`, and nobody has followed to its very end.

        Nothing where all of that is past help: where exactly they end is then nobody's concern.
        """
        group = [t for t in scored_fits if t.cost < self.reach(best)]
        if all(t.past_help for t in group):
            return []
        return [t.fitted for t in group if t.fitted not in self._ends]

    def keep_converged(self, fits: Sequence[Refitted], ends: Iterable[Refitted]) -> None:
        """Where some fits end."""
        self._ends |= dict(zip(fits, ends, strict=True))

    def _at_its_end(self, scored: ScoredFit) -> ScoredFit:
        end = self._ends.get(scored.fitted, scored.fitted)
        # Laplace's cost holds only at a minimum: keep the lower chi-square, even at a higher cost.
        return self.judged(end) if end.chi2 < scored.fitted.chi2 else scored

    def freer(self, scored_fits: Sequence[ScoredFit], best: ScoredFit) -> list[ScoredFit]:
        """Single effects that may be in one group with `best`, their laws bent as far as the data ask for.

        Only those whose data do. Two effects and a rare material would be too much at once.
        """
        near = [t.fitted for t in scored_fits if t.cost < self.reach(best)]
        begun = [f for f in near if sum(e.causes for e in f.effects) == 1]
        found = self.executor.map(self.work.loosen_as_asked, begun)
        return [self.judged(f) for f in found if freedom_of(f.law) > freedom_of(self.stated)]

    def simpler(self, scored_fits: Sequence[ScoredFit]) -> list[ScoredFit]:
        """What effects contain in their places, fitted from where each was found."""
        begun = [one for scored in scored_fits for one in self._contained(scored.fitted)]
        return [self.judged(f) for f in self.executor.starmap(self.work.fit, begun)]

    def elsewhere(self, scored: ScoredFit) -> list[ScoredFit]:
        """A single effect fitted from other places of its own, its law as it was found."""
        effect, *more = scored.fitted.effects
        if more or effect.replaces_law:
            return []
        places = effect.elsewhere(self.problem.plate, scored.fitted.of(effect))
        begun = [FromLaw([effect], scored.fitted.law, np.concatenate([scored.fitted.z, u])) for u in places]
        return [self.judged(f) for f in self.executor.starmap(self.work.fit, begun)]

    def twofold(self, scored_fits: Sequence[ScoredFit]) -> list[ScoredFit]:
        """Fits of two of a kind (two masses), from where a single one was found and a second place."""
        begun = [one for scored in scored_fits for one in self._doubled(scored.fitted)]
        found = self.executor.starmap(self.work.fit, begun)
        return [self.judged(f) for f in found if self.determined(f)]

    def _doubled(self, fitted: Refitted) -> list[FromLaw]:
        one, *more = fitted.effects
        wider = [] if more else [e for e in self.effects if e.twice and e.extends == one.name]
        if not wider:
            return []
        others = look(self.problem, self.evidence, fitted, one)[: STARTS.followed_with_place]
        known = np.concatenate([fitted.z, fitted.of(one)])
        return [FromLaw([e], fitted.law, np.concatenate([known, u])) for e in wider for _, u in others]

    def _contained(self, fitted: Refitted) -> list[FromLaw]:
        """Effects, law and unknowns to begin from, for each that one of a fit contains."""
        if any(e.replaces_law for e in fitted.effects):
            return []
        known, found = {e.name for e in self.effects}, []
        for k, effect in enumerate(fitted.effects):
            for part, u in effect.within(fitted.of(effect)):
                effects = [*fitted.effects[:k], part, *fitted.effects[k + 1 :]]
                if part.name in known and len({e.name for e in effects}) == len(effects):
                    parts = [u if e is part else fitted.of(e) for e in effects]
                    found.append(FromLaw(effects, fitted.law, np.concatenate([fitted.z, *parts])))
        return found

    def determined(self, fitted: Refitted) -> bool:
        """Whether the data leave over what a fit needs."""
        return fitted.parameter_count <= self.evidence.count - _SPARE

    def fit_plainly(self, names: Sequence[str]) -> None:
        """These effects from plain starts, in wide valleys."""
        work = self.work
        tasks = [(n, work.state(n)) for n in names]
        for name, state in zip(names, self.executor.starmap(work.fit_plain, tasks), strict=True):
            work.learn(name, state)

    def order_of_plain(self) -> list[str]:
        """Effects by how well they do from plain starts, in wide valleys."""
        names = [e.name for e in self.beside_the_law if e.parameters]
        self.fit_plainly(names)
        return sorted(names, key=lambda name: min(f.chi2 for f in self.work.candidates[name][0].fit_plain()))

    def fitted_by_hand(self, effects: Sequence[Effect]) -> ScoredFit:
        """These effects together, none of them weighed."""
        fitted = self.none.fitted
        # Another law comes first: the others are then fitted beside it.
        for effect in sorted(effects, key=lambda e: not e.replaces_law):
            if effect.replaces_law:
                fits = self.work.fit_other_laws(effect)
                fitted = min(fits, key=lambda f: self.judged(f).cost)
                continue
            forms = effect.forms(self.problem.points, self.problem.plate)
            candidates = [CandidateFit(self.problem, self.evidence, fitted, form) for form in forms]
            fits = [c.finished(f) for c in candidates for f in [*c.fit_near()[:1], *c.fit_far()[:1]]]
            fitted = min(fits, key=by_chi2)
        return self.judged(fitted)
