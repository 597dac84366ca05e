"""Two effects together, where one does not suffice."""

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from fitting.diagnosis.executor import Call
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search, best_of_each, by_cost
from fitting.diagnosis.search.looks import Start, has_place
from fitting.diagnosis.search.tasks import Beside, Form
from fitting.diagnosis.thresholds import PAIRS, SEARCH, STOPPING, WIDE_VALLEYS
from fitting.effects.base import Effect
from fitting.progress import Report, unheard

A = TypeVar("A")
Seen = tuple[ScoredFit, Form, list[Start]]
"""A single effect, the form of a second one, and that one's starts beside it, best first."""

_LOOKED_AT = 6
"""Forms that are looked at in one go: few enough that all processes end at about the same time. A choice."""


class Pairs:
    """The pairs of effects that one search tries."""

    def __init__(self, search: Search) -> None:
        self._search = search

    def best(self, singles: Sequence[ScoredFit], report: Report, *, wide: bool) -> list[ScoredFit]:
        """Second effects beside the leading single ones, and each of the best two alone; best first.

        Where one suffices (not `wide`), beside those near it.
        """
        search = self._search
        found = self._first(singles, report, wide=wide)
        report(0.9)
        if not found:
            return []
        pair = min(found, key=by_cost)
        alone = search.alone(pair)
        # A pair may only have revealed one of its effects: then pairs with that one are searched.
        led = any(search.suffices(t) and t.cost < pair.cost for t in alone)
        if pair.cost < singles[0].cost and not led:
            found += self._improved(found)
            last = min(found, key=by_cost)
            alone += search.alone(last) if last is not pair else []
        return best_of_each([*found, *alone])

    def _first(self, singles: Sequence[ScoredFit], report: Report, *, wide: bool) -> list[ScoredFit]:
        """Beside the leading single effects, those that promise most; where none will do, every one."""
        search, work, starmap = self._search, self._search.work, self._search.executor.starmap
        seen = self._beside_all if wide else self._beside_the_near
        chosen = seen(singles, lambda x: report(0.4 * x))
        full = [(t.fitted, form, starts, np.inf) for t, form, starts in chosen]
        begun = starmap(work.fit_second_roughly, full, lambda x: report(0.4 + 0.2 * x))
        rough = _longest_first([f for f in begun if f is not None])
        best = search.judged(min(rough, key=by_chi2)) if rough and wide else None
        if best:
            rough = [f for f in rough if f.chi2 < STOPPING.rough_chi2_factor * best.fitted.chi2]
        asked = [(f, self._goal(best, f.effects) if best else np.inf) for f in rough]
        fits = starmap(work.follow_to_end, asked, lambda x: report(0.6 + 0.2 * x))
        found = sorted((search.judged(f) for f in fits), key=by_cost)
        if wide and found and not self._will_do([*singles[:1], *found]):
            # The best may only have begun from the wrong place, or not have looked promising.
            plain = [t for t in singles if _plainly(t)]
            found += self._every_second(plain, found, self._most_left([*plain, *found]))
        return found

    def _beside_all(self, singles: Sequence[ScoredFit], report: Report) -> list[Seen]:
        """What promises most beside the leading ones."""
        asked = [(t, self._others(t.names)) for t in singles[: SEARCH.leaders]]
        return self._chosen(self._seen(asked, report))

    def _beside_the_near(self, singles: Sequence[ScoredFit], report: Report) -> list[Seen]:
        """Beside the best what promises more than it costs, beside those near it what may come as far."""
        search = self._search
        scale = search.temper(singles[0])
        best, *near = search.leading(singles, scale)[: PAIRS.close_leaders]
        first = self._seen(
            [(best, self._others(best.names))], lambda x: report(0.5 * x), search.moving(singles, best)
        )
        owed = {t: t.cost - best.cost + PAIRS.least_promise / 2 * scale for t in near}
        owed[best] = PAIRS.least_promise * scale
        promised = {form: _promise(starts) for _, form, starts in first}
        asked = []
        for t in near:
            most = {
                form: _most_beside(t.fitted, best.fitted, promised.get(form, np.inf))
                for form in self._others(t.names)
            }
            asked.append((t, [form for form, gain in most.items() if gain > owed[t]]))
        seen = [*first, *self._seen(asked, lambda x: report(0.5 + 0.5 * x))]
        return self._chosen([one for one in seen if _promise(one[2]) > owed[one[0]]])

    def _seen(
        self,
        asked: Sequence[tuple[ScoredFit, Sequence[Form]]],
        report: Report,
        moving: Sequence[Refitted] = (),
    ) -> list[Seen]:
        """What is seen of every form beside its fit."""
        besides = [Beside(t.fitted, forms) for t, forms in asked]
        looks = self._looks(self._search.work.look, besides, report, moving)
        each = [(t, form) for t, forms in asked for form in forms]
        return [(t, form, starts) for (t, form), starts in zip(each, looks, strict=True)]

    def _chosen(self, seen: Sequence[Seen]) -> list[Seen]:
        """What promises to come furthest, each pair once."""
        chosen: dict[frozenset[str], Seen] = {}
        beside: dict[ScoredFit, int] = {}
        for one in sorted(seen, key=lambda one: one[0].fitted.chi2 - _promise(one[2])):
            scored, (name, _), _ = one
            # Each leader has its say: a linear step from a poor one promises too much.
            if len(chosen) < PAIRS.fitted and beside.get(scored, 0) < PAIRS.fitted_a_leader:
                beside[scored] = beside.get(scored, 0) + 1
                chosen.setdefault(frozenset((*scored.names, name)), one)
        return list(chosen.values())

    def _looks(
        self,
        do: Callable[[Refitted, Sequence[Form]], list[A]],
        asked: Sequence[Beside],
        report: Report = unheard,
        moving: Sequence[Refitted] = (),
    ) -> list[A]:
        """What is seen of every form beside its fit, in order; some at a time, as that fit is one.

        What is still `moving` is followed to its very end meanwhile.
        """
        some = [
            Beside(before, forms[k : k + _LOOKED_AT])
            for before, forms in asked
            for k in range(0, len(forms), _LOOKED_AT)
        ]
        calls: list[Call] = [(self._search.work.follow_to_convergence, (fitted,)) for fitted in moving]
        calls += [(do, one) for one in some]
        found = list(self._search.executor.together(calls, report))
        self._search.keep_converged(moving, found[: len(moving)])
        return [one for looks in found[len(moving) :] for one in looks]

    def _most_left(self, known: Sequence[ScoredFit]) -> float:
        """Chi-square that a pair may leave in its wide valley: twice what the best so far leave, or noise."""
        work = self._search.work
        plain = sorted((t for t in known if len(_plainly(t)) == len(t.names)), key=by_cost)
        best = [t.fitted for t in plain[: WIDE_VALLEYS.measured]]
        left = self._search.executor.map(work.left_in_wide_valley, best)
        return WIDE_VALLEYS.times_least_left * max(work.noise_in_wide_valleys, min(left, default=np.inf))

    def _will_do(self, scored_fits: Sequence[ScoredFit]) -> bool:
        """Whether any, the law being of the stated kind, leaves little and fails no check."""
        plain = (t for t in scored_fits if len(_plainly(t)) == len(t.names))
        return any(
            t.fitted.chi2_per_dof < PAIRS.will_do_chi2_per_dof * self._search.allowed(t) and not t.fails
            for t in plain
        )

    def _goal(self, best: ScoredFit, effects: Sequence[Effect]) -> float:
        """Chi-square that a pair must come down to: near to the best, or to where nothing may refuse it."""
        return max(self._search.work.goal(best.fitted), self._search.unrefused(effects))

    def _others(self, names: Sequence[str]) -> list[Form]:
        """Every form of the effects that may stand beside some."""
        return [
            (e.name, number)
            for e in self._search.effects
            if e.name not in names and not e.replaces_law
            for number, candidate in enumerate(self._search.work.candidates[e.name])
            if candidate.effect.beside_others
        ]

    def _every_second(
        self, leaders: Sequence[ScoredFit], pairs: Sequence[ScoredFit], most: float
    ) -> list[ScoredFit]:
        """Every effect beside the leading ones; the best pairs to the end.

        All begin where a leading one alone has come to in its wide valley. Those that do well go on there;
        what leaves no more than `most` there goes on as the readings are, then to the end.
        """
        search, work, executor = self._search, self._search.work, self._search.executor
        order = [
            *(t.names[0] for t in leaders[: WIDE_VALLEYS.leaders]),
            *search.order_of_plain()[: WIDE_VALLEYS.leaders],
        ]
        # Two of a kind and another one are three causes, which are never named (decision 57).
        single = {e.name: e.extends if e.twice and e.extends else e.name for e in search.effects}
        first = sorted({single[name] for name in order if name in single} & single.keys())
        others = [self._others([name]) for name in first]
        before = [work.candidates[name][0].fit_plain()[0] for name in first]
        asked = [Beside(fitted, forms) for fitted, forms in zip(before, others, strict=True)]
        starts = self._looks(work.look_wide, asked)
        beside = [(fitted, form) for fitted, forms in asked for form in forms]
        tasks = [(fitted, form, us) for (fitted, form), us in zip(beside, starts, strict=True)]
        all_begun = executor.starmap(work.begin_wide, tasks)
        able = [fits for fits in all_begun if fits[0].chi2 < WIDE_VALLEYS.falls_by * most]
        begun = sorted(able, key=lambda fits: fits[0].chi2)
        wide = executor.map(work.follow_wide, [f for fits in _with_a_say(begun) for f in fits])
        brief = sorted(executor.map(work.follow_briefly, [f for f in wide if f.chi2 < most]), key=by_chi2)
        rough = sorted(executor.map(work.follow_roughly, brief[: WIDE_VALLEYS.read]), key=by_chi2)
        best = min([*leaders, *pairs], key=by_cost)
        left = _longest_first(rough[: PAIRS.fitted_a_leader])
        ended = executor.starmap(work.follow_to_end, [(f, self._goal(best, f.effects)) for f in left])
        return [search.judged(f) for f in ended]

    def _improved(self, pairs: Sequence[ScoredFit]) -> list[ScoredFit]:
        """What is found by keeping one effect of the best pairs, each once, and exchanging the other one.

        A wrong one may have led to the right other one, and stands where the right one would begin.
        """
        found, kept, simplified = list[ScoredFit](), set[str](), set[frozenset[str]]()
        for _ in range(PAIRS.exchanges):
            pair = self._next([*pairs, *found], kept)
            # Where even the best will not do, neither will those that are as bad: two have been kept for it.
            if pair is None or (pair.fails and len(kept) >= len(pair.names)):
                break
            one = next(e for e in pair.fitted.effects if e.name not in kept)
            kept.add(one.name)
            new = self._exchanged(pair, one)
            if frozenset(pair.names) not in simplified:
                simplified.add(frozenset(pair.names))
                new += self._search.simpler([pair])
            # Followed to convergence: a fit in a slow valley would be discarded too early.
            found += self._search.converged_group(new, min([pair, *new], key=by_cost))
        return found

    def _next(self, pairs: Sequence[ScoredFit], kept: set[str]) -> ScoredFit | None:
        """The best pair that has an effect which was not kept so far, if it is near the best of all."""
        plain = [t for t in sorted(pairs, key=by_cost) if len(_plainly(t)) == 2]
        if not plain:
            return None
        best = next((t for t in plain if not t.fails), plain[0])
        within = best.cost + STOPPING.cost_near_best_settled * self._search.temper(best)
        near = [best, *(t for t in plain if t.cost < within)]
        return next((t for t in near if not kept >= set(t.names)), None)

    def _exchanged(self, pair: ScoredFit, kept: Effect) -> list[ScoredFit]:
        """Another effect, another place of the same, or another law beside the one of a pair that is kept."""
        work = self._search.work
        before = work.evaluate_alone(pair.fitted, kept)
        gone = {*pair.names} - {kept.name}
        forms = [f for f in self._others([kept.name]) if f[0] not in gone or work.has_places(f[0])]
        seen = self._looks(work.look, [Beside(before, forms)])
        looks = [one for one in zip(forms, seen, strict=True) if one[1]]
        promising = sorted(looks, key=lambda one: -one[1][0][0])[: PAIRS.exchanged]
        promising.sort(key=lambda one: not work.has_places(one[0][0]))
        goal = work.goal(pair.fitted)
        laws = [e.name for e in self._search.effects if e.replaces_law]
        # The longest first, so that all worker processes end together.
        calls: list[Call] = [(work.fit_other_laws_beside, (before, name, goal)) for name in laws]
        calls += [(work.fit_second, (before, form, starts, goal)) for form, starts in promising]
        found = list(self._search.executor.together(calls))
        fits = [f for f in found[len(laws) :] if f is not None]
        return [self._search.judged(f) for f in [*fits, *(f for bent in found[: len(laws)] for f in bent)]]


def _with_a_say(begun: Sequence[list[Refitted]]) -> list[list[Refitted]]:
    """Of fits of pairs, the best pair first: the best few of each leader, and the best of the others."""
    beside: dict[str, int] = {}
    chosen, left = list[list[Refitted]](), list[list[Refitted]]()
    for fits in begun:
        name = fits[0].effects[0].name
        beside[name] = beside.get(name, 0) + 1
        (chosen if beside[name] <= PAIRS.fitted_a_leader else left).append(fits)
    return chosen + left[: max(0, WIDE_VALLEYS.followed - len(chosen))]


def _promise(starts: Sequence[Start]) -> float:
    """The chi-square that the best of some starts may gain."""
    return starts[0][0] if starts else 0.0


def _most_beside(fitted: Refitted, best: Refitted, promised: float) -> float:
    """The chi-square that a form may gain beside a fit, of what it promises beside the best one.

    What it may gain is the square of a part of what is left, and no part differs by more than the whole does.
    """
    apart = fitted.residuals[: fitted.data] - best.residuals[: best.data]
    return float((np.sqrt(max(promised, 0.0)) + np.linalg.norm(apart)) ** 2)


def _longest_first(rough: Sequence[Refitted]) -> list[Refitted]:
    """Rough fits, the longest to follow first, so that all worker processes end together."""
    return sorted(rough, key=lambda f: (f.converged, -sum(has_place(e) for e in f.effects)))


def _plainly(scored: ScoredFit) -> list[str]:
    """Its effects beside the law."""
    return [e.name for e in scored.fitted.effects if not e.replaces_law]
