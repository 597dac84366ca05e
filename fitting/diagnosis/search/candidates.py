"""One effect beside a fit so far: rough fits from what a first look promises, then a fit to the end."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refit import ROUGH, refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.inference.usual_law import finished, within_search
from fitting.diagnosis.inference.wide_valley import in_wide_valley, of_effects, with_stated
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.response.response import Response
from fitting.diagnosis.search.looks import Start, has_place, look
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.thresholds import STARTS
from fitting.effects.base import Effect
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw

_NEAR_BY = 3.0
"""Times: starts of an unknown over decades that are no further apart lead to the same place. A choice."""


@dataclass
class CandidateState:
    """What a candidate has found so far; None where nobody has asked."""

    starts: Sequence[Start] | None = None
    near: list[Refitted] | None = None
    elsewhere: list[Refitted] | None = None
    plain: list[Refitted] | None = None
    far: list[Refitted] | None = None


class CandidateFit:
    """Fits of the data with one more effect, as far as anyone asked for them: what was found is kept."""

    def __init__(
        self,
        problem: DiagnosisProblem,
        evidence: Evidence,
        before: Refitted,
        effect: Effect,
        starts: Sequence[Start] | None = None,
        goal: float = np.inf,
        *,
        one: bool = False,
    ) -> None:
        """`starts` as `look` gives them, where they are known; `goal` as `refit` takes it.

        `one`: of all starts only what leads furthest is asked for.
        """
        self.problem, self.evidence, self.before = problem, evidence, before
        self.effect, self._goal, self._one = effect, goal, one
        self._known = CandidateState(starts)
        self._quick: list[Refitted] | None = None

    @property
    def known(self) -> CandidateState:
        """What has been asked for so far."""
        return replace(self._known)

    def learn(self, known: CandidateState) -> None:
        """What the same candidate has found elsewhere."""
        found = {field.name: getattr(known, field.name) for field in fields(known)}
        self._known = replace(self._known, **{k: v for k, v in found.items() if v is not None})

    def find_starts(self) -> Sequence[Start]:
        """As `look` gives them."""
        if self._known.starts is None:
            self._known.starts = look(self.problem, self.evidence, self.before, self.effect)
        return self._known.starts

    def __getstate__(self) -> dict[str, object]:
        # Another process makes its own response: with its plates it is far larger than all that is known.
        return {name: value for name, value in vars(self).items() if name != "_response"}

    @cached_property
    def _response(self) -> Response:
        return response_of(self.problem, [*self.before.effects, self.effect], self.problem.coarse)

    def _rough(
        self,
        law: CoreLaw,
        u: Array,
        *,
        brief: bool = False,
        rival: float = np.inf,
    ) -> Refitted:
        start = np.concatenate([self.before.u, u])
        return refit(
            self._response,
            self.evidence,
            law,
            start,
            tolerance=ROUGH,
            brief=brief,
            goal=self._goal,
            rival=rival,
        )

    @cached_property
    def _law(self) -> CoreLaw:
        """The law so far, or the usual one nearest to it: at its limits it is no place to begin."""
        return within_search(self.before.law, self.problem.points.omega)

    def fit_near(self) -> list[Refitted]:
        """Rough fits from the law so far and the starts that promise most; best first."""
        if self._known.near is None:
            starts = enumerate(self.find_starts()[: self._first])
            promising = [
                s for k, s in starts if not k or self._is_told_nothing(s) or s[0] > self._least_promise()
            ]
            heard = {self._form(u) for _, u in promising}
            promising += [s for s in self._one_a_form() if self._form(s[1]) not in heard]
            near = self._from([*promising, *self._decades_off(promising)])
            if self.effect.from_afar:
                near = sorted([*near, *self.fit_quickly()], key=by_chi2)
            self._known.near = near
        return self._known.near

    def _decades_off(self, followed: Sequence[Start]) -> list[Start]:
        """An effect's own first start, where none that is followed is near it.

        A linear step may make a spring hundreds of times stiffer, so that it does nothing any more; then a
        softer one is tried too.
        """
        if not is_over_decades(self.effect):
            return []
        own = self._first_start
        decades = [q.logarithmic and not q.fixed for q in self.effect.parameters]
        near = [np.abs(np.log(u[decades] / own[decades])).max() < np.log(_NEAR_BY) for _, u in followed]
        return [] if any(near) else [(0.0, own)]

    def _one_a_form(self) -> list[Start]:
        """The best start of each form; of an effect with a place, the best of all.

        Stated numbers may already imitate the effect, and a linear step then promises too little: every form
        is tried once.
        """
        best: dict[tuple[float, ...], Start] = {}
        starts = self.find_starts()
        for start in starts[:1] if has_place(self.effect) else starts:
            best.setdefault(self._form(start[1]), start)
        return list(best.values())

    def _form(self, u: Array) -> tuple[float, ...]:
        """Which of an effect's forms a start is of: its values that are not fitted."""
        return tuple(float(x) for x, q in zip(u, self.effect.parameters, strict=True) if q.fixed)

    def promise(self) -> float:
        """Chi-square that the best start may gain."""
        return next((promise for promise, _ in self.find_starts()), 0.0)

    def is_open(self) -> bool:
        """Whether a linear step cannot tell what an effect may gain; of many places the best one counts."""
        starts = self.find_starts()
        return any(promise == 0 for promise, _ in (starts[:1] if has_place(self.effect) else starts))

    def briefly(self) -> list[Refitted]:
        """A few steps from the best start of each form: where the effect cannot be what is looked for."""
        return [self._rough(self._law, u, brief=True) for _, u in self._one_a_form()]

    def fit_elsewhere(self) -> list[Refitted]:
        """Rough fits from some more starts of an effect whose place is to be found: valleys are many."""
        if self._known.elsewhere is None:
            self._known.elsewhere = self._from(self.further_starts())
        return self._known.elsewhere

    def further_starts(self) -> Sequence[Start]:
        """The starts that the fits of `fit_elsewhere` begin from."""
        return self.find_starts()[self._first : self._first + self._more]

    def last_starts(self) -> Sequence[Start]:
        """Those that are left."""
        followed = self._first + self._more
        return self.find_starts()[followed : followed + STARTS.last]

    def _is_told_nothing(self, start: Start) -> bool:
        return start[0] == 0 and not has_place(self.effect)

    def _least_promise(self) -> float:
        """Chi-square that a further start must promise to be followed."""
        return max(STARTS.least_promise, STARTS.least_share_of_best_promise * self.find_starts()[0][0])

    @property
    def _first(self) -> int:
        return STARTS.followed_with_place if has_place(self.effect) else STARTS.followed

    @property
    def _more(self) -> int:
        return STARTS.further if has_place(self.effect) else 0

    def _from(self, starts: Sequence[Start]) -> list[Refitted]:
        if not self._one:
            return sorted((self.followed(start) for start in starts), key=by_chi2)
        found = list[Refitted]()
        for start in starts:
            found.append(self.followed(start, min((f.chi2 for f in found), default=np.inf)))
        return sorted(found, key=by_chi2)

    def followed(self, start: Start, rival: float = np.inf) -> Refitted:
        """A rough fit from one start, a few steps of it where little is promised and no more gained.

        `rival` as `refit` takes it.
        """
        promise, u = start
        if 0 < promise < STARTS.least_promise:
            brief = self._rough(self._law, u, brief=True)
            if brief.converged or abs(self.before.chi2 - brief.chi2) < STARTS.least_gain:
                return brief
        return self._rough(self._law, u, rival=rival)

    def set_out(self, start: Start) -> Refitted:
        """A few steps from one start."""
        return self._rough(self.before.law, start[1], brief=True)

    def gone_on(self, begun: Refitted, rival: float = np.inf) -> Refitted:
        """What has set out followed roughly; `rival` as `refit` takes it."""
        if begun.converged:
            return begun
        return refit(self._response, self.evidence, begun.law, begun.u, tolerance=ROUGH, rival=rival)

    def fit_plain(self) -> list[Refitted]:
        """Rough fits in wide valleys from the first start, from the law so far and the stated one."""
        if self._known.plain is None:
            self._known.plain = self._wide(self._first_start)
        return self._known.plain

    def fit_quickly(self) -> list[Refitted]:
        """One rough fit, begun in a wide valley from the better of the first and the most promising start.

        Of an effect with a place, from the best of the most promising ones.
        """
        if self._quick is not None:
            return self._quick
        if has_place(self.effect):
            wide = min(self._wide_places(self._promising_places() or [self._first_start]), key=by_chi2)
        else:
            starts = [self._first_start, *self._promising_elsewhere()]
            wide = min((self._in_wide_valley(self._law, u) for u in starts), key=by_chi2)
        u = with_stated(self.problem, wide)
        self._quick = [refit(self._response, self.evidence, wide.law, u, tolerance=ROUGH)]
        return self._quick

    def fit_far(self) -> list[Refitted]:
        """Those of `fit_plain`, and from the starts that promise most.

        A linear step from a wrong law may lead astray: of places it says only which few to try.
        """
        if self._known.far is None:
            if has_place(self.effect):
                places = [u for u in self._promising_places() if not np.array_equal(u, self._first_start)]
                begun = self._wide_places(places)
            else:
                begun = [f for u in self._promising_elsewhere() for f in self._wide(u)]
            self._known.far = sorted([*self.fit_plain(), *begun], key=by_chi2)
        return self._known.far

    def _promising_places(self) -> list[Array]:
        return [u for _, u in self.find_starts()[: STARTS.followed_with_place]]

    def _wide_places(self, starts: Sequence[Array]) -> list[Refitted]:
        """In wide valleys, what has come furthest from some starts after a few steps; (parameters,) each."""
        brief = (self._in_wide_valley(law, u, brief=True) for law in self._laws for u in starts)
        going = sorted(brief, key=by_chi2)[: STARTS.followed]
        return [in_wide_valley(self.problem, f.effects, self.evidence, f.law, of_effects(f)) for f in going]

    @property
    def _first_start(self) -> Array:
        return self.effect.starts(self.problem.plate, self.problem.points)[0]

    def _promising_elsewhere(self) -> list[Array]:
        """The start that promises most, where it is not the first one: of that, a step may change nothing."""
        return [u for _, u in self.find_starts()[:1] if not np.array_equal(u, self._first_start)]

    def _wide(self, u: Array) -> list[Refitted]:
        return sorted((self._in_wide_valley(law, u) for law in self._laws), key=by_chi2)

    @property
    def _laws(self) -> tuple[CoreLaw, CoreLaw]:
        """What fits in wide valleys begin from: the law so far, and the stated one."""
        return self._law, bent_as(self.before.law, self.problem.stated_law)

    def _in_wide_valley(self, law: CoreLaw, u: Array, *, brief: bool = False) -> Refitted:
        # Without the effect the stated numbers may have been moved to do its work.
        begun = np.concatenate([of_effects(self.before), u])
        effects = [*self.before.effects, self.effect]
        return in_wide_valley(self.problem, effects, self.evidence, law, begun, brief=brief)

    def finished(self, rough: Refitted, goal: float = np.inf) -> Refitted:
        """A rough fit followed to the end, or to where a chi-square of `goal` is out of reach."""
        return finished(self.problem, self.evidence, rough, goal)


def bent_as(law: CoreLaw, other: CoreLaw) -> CoreLaw:
    """Another law, as free to bend as one is."""
    return BentLaw.over(other, np.array(law.knots_hz), law.freedom) if isinstance(law, BentLaw) else other


def is_over_decades(effect: Effect) -> bool:
    """Whether an unknown without a place may be of any size within decades."""
    return not has_place(effect) and any(q.logarithmic and not q.fixed for q in effect.parameters)
