"""Every effect beside the law, one at a time: what promises most first, what leads gone into twice."""

from collections.abc import Iterable, Sequence

import numpy as np

from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.search.candidate_fits import FirstLook
from fitting.diagnosis.search.candidates import CandidateState, is_over_decades
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search, by_cost
from fitting.diagnosis.search.looks import has_place
from fitting.diagnosis.search.tasks import Form, FormFit, FormStart, State, ToFollow
from fitting.diagnosis.thresholds import SEARCH, STARTS, STOPPING, VERDICT
from fitting.numerics.chances import chi2_above
from fitting.progress import Report, unheard


class Singles:
    """The single effects that one search tries."""

    def __init__(self, search: Search, report: Report) -> None:
        self._search, self._work, self._report = search, search.work, report
        self._map, self._starmap = search.executor.map, search.executor.starmap
        self._found: dict[str, ScoredFit] = {}
        self._effects = {e.name: e for e in search.beside_the_law}
        self._laws = [e.name for e in search.effects if e.name not in self._effects]
        self._settled = False
        self._finished = dict[Refitted, float]()
        """Rough fits that have been followed to their end, and the chi-square they had to come down to."""

    def best(self) -> list[ScoredFit]:
        """One scored fit of each effect, best first."""
        self._first_pass()
        ahead = [best for name in self._ahead() for best in self._work.best_near(name)]
        # All that is known to be followed in one go, so that all worker processes end together.
        self._finish([*ahead, *self._dismissed_on_the_way()], self._part(0.4, 0.2))
        self._finish(self._dismissed_on_the_way(), self._part(0.6, 0.1))
        self._second_pass()
        self._look_everywhere(self._misplaced(), self._part(0.9, 0.1))
        return self._order()

    def _first_pass(self) -> None:
        """Everything roughly; from the law of what explains everything, if one that promises much does."""
        work = self._work
        first = self._leading()
        if first:
            begun = self._starmap(work.begin, self._of_effects(first), self._part(0.1, 0.1))
            self._begin(begun)
            self._finish([f for t in self._order()[:1] for f in self._near(t)])
            again = [n for t in self._order()[:1] if self._leans(t) for n in t.names]
            self._look_far(again)
            self._to_the_end([ToFollow(*one, np.inf) for n in again for one in work.from_stated(n)])
        if not self._settle(self._part(0.2, 0.2)):
            left = [n for n in (*self._laws, *self._effects) if n not in first]
            self._begin(self._starmap(work.begin, self._of_effects(left), self._part(0.2, 0.2)))

    def _second_pass(self) -> None:
        """Further starts of what leads, and of more where the law is no place to begin."""
        work, left, astray = self._work, self._worth_more(), self._astray
        while left:
            some, left = (left[: SEARCH.at_a_time], left[SEARCH.at_a_time :]) if astray else (left, [])
            self._look_around(some, astray=astray)
            best = [one for name in some for one in work.thorough(name, astray=astray)]
            asked = [ToFollow(form, rough, self._goal(rough) if astray else np.inf) for form, rough in best]
            self._to_the_end(asked, self._part(0.7, 0.1))
            if astray and self._settle(self._part(0.8, 0.1)):
                break

    def _look_around(self, names: Sequence[str], *, astray: bool) -> None:
        """Rough fits from further starts of some effects, and far ones where the law is no place to begin."""
        work, found = self._work, dict[Form, list[Refitted]]()
        asked = [one for name in names for one in work.unfollowed(name)]
        for (form, *_), fitted in zip(asked, self._followed(asked), strict=True):
            found.setdefault(form, []).append(fitted)
        for form, fits in found.items():
            work.candidate(form).learn(CandidateState(elsewhere=sorted(fits, key=by_chi2)))
        if astray:
            self._look_far(names)

    def _look_everywhere(self, names: Sequence[str], report: Report) -> None:
        """The best of some effects' fits from all starts that are left, to the end."""
        work = self._work
        asked = [one for name in names for one in work.unfollowed(name, every=True)]
        found = [FormFit(one.form, f) for one, f in zip(asked, self._followed(asked), strict=True)]
        best = list[FormFit]()
        for name in names:
            mine = [*work.elsewhere(name), *(one for one in found if one.form[0] == name)]
            best += sorted(mine, key=lambda one: one.fitted.chi2)[: STARTS.finished]
        self._to_the_end([ToFollow(*one, np.inf) for one in best], report)

    def _look_far(self, names: Sequence[str]) -> None:
        """Rough fits of some effects in wide valleys."""
        work = self._work
        each = [((name, k), known) for name in names for k, known in enumerate(work.state(name))]
        asked = [(form, known) for form, known in each if known.far is None]
        for (form, _), known in zip(asked, self._starmap(work.fit_far, asked), strict=True):
            work.candidate(form).learn(known)

    def _followed(self, asked: Sequence[FormStart]) -> list[Refitted]:
        """Rough fits from some starts, in order. Of many of an effect those that have come furthest go on."""
        work, order = self._work, dict[str, list[int]]()
        begun = list(self._starmap(work.set_out, [(one.form, one.start) for one in asked]))
        for k in sorted(range(len(asked)), key=lambda k: begun[k].chi2):
            order.setdefault(asked[k].form[0], []).append(k)
        going = [k for places in order.values() for k in places[: STARTS.further_continued]]
        tasks = [ToFollow(asked[k].form, begun[k], asked[k].rival) for k in going]
        for k, fitted in zip(going, self._starmap(work.go_on, tasks), strict=True):
            begun[k] = fitted
        return begun

    def _settle(self, report: Report) -> bool:
        """Whether an effect explains all there is: then all others begin again from its law."""
        work, best = self._work, next(iter(self._order()), None)
        if best is None or not self._explains_all(best):
            return False
        self._settled = True
        others = [n for n in (*self._laws, *self._effects) if n not in best.names]
        tasks = [(n, work.state(n), best.fitted) for n in others]
        self._begin(self._starmap(work.begin_beside_the_best, tasks, report))
        self._try_its_other_form(best)
        return True

    def _try_its_other_form(self, best: ScoredFit) -> None:
        """Where two forms did alike so far, both from the law of the one that explains everything."""
        work, alike = self._work, [form for form, _ in self._near(best)]
        if len(alike) < STARTS.forms:
            return
        each = self._starmap(work.fit_another_form, [(form, best.fitted) for form in alike])
        found = [(form, rough) for form, fits in zip(alike, each, strict=True) for rough in fits[:1]]
        self._to_the_end([ToFollow(form, rough, work.goal(best.fitted)) for form, rough in found])

    def _explains_all(self, scored: ScoredFit) -> bool:
        best = scored.fitted
        enough = (
            self._search.none.cost - scored.cost > STOPPING.least_gain_in_cost
            and best.chi2_per_dof < STOPPING.explained_chi2_per_dof
        )
        return enough and not scored.fails and not _may_stand_for_another(scored)

    def _leans(self, scored: ScoredFit) -> bool:
        """Whether a fit holds stated numbers implausibly far off, as it began from a law far off.

        They are held against their tolerances alone, however much the fit explains.
        """
        fitted = scored.fitted
        asked = chi2_above(float(fitted.z @ fitted.z), fitted.stated) if fitted.stated else 1.0
        return self._astray and asked < VERDICT.check_level

    # What has been found.

    def _keep(self, fits: Iterable[Refitted]) -> None:
        for scored in (self._search.judged(f) for f in fits if self._search.determined(f)):
            name = scored.names[0]
            if name not in self._found or scored.cost < self._found[name].cost:
                self._found[name] = scored

    def _finish(self, rough: Iterable[FormFit], report: Report = unheard) -> None:
        """What may come near to what explains everything, if anything does, followed to its end, once."""
        new = {f: form for form, f in rough if f not in self._finished and self._may_matter(f)}
        self._to_the_end([ToFollow(form, f, self._goal(f)) for f, form in new.items()], report)

    def _may_matter(self, rough: Refitted) -> bool:
        """Whether a rough fit may still come near enough, at its pace and by what is left to gain.

        What is of any size within decades has valleys that a linear step does not see the end of.
        """
        goal = self._goal(rough)
        if not rough.may_reach(goal):
            return False
        winds = any(is_over_decades(e) for e in rough.effects)
        return winds or rough.chi2 - STOPPING.times_owed * rough.owed < goal

    def _to_the_end(self, asked: Iterable[ToFollow], report: Report = unheard) -> None:
        """Rough fits, each with its goal as `refit` takes it; none again that has gone as far."""
        tasks = [one for one in asked if one.goal > self._finished.get(one.fitted, -np.inf)]
        self._finished |= {f: goal for _, f, goal in tasks}
        self._keep(self._starmap(self._work.finish, tasks, report))

    def _goal(self, rough: Refitted) -> float:
        """Chi-square that a rough fit must come down to, to matter.

        Near to what explains everything, if anything does. Where the law is no place to begin: to where no
        check refuses it by its size, or near to the last of those that a second effect is looked for beside,
        which by the end will be no worse than now.
        """
        search, order = self._search, self._order()
        if self._settled:
            return self._work.goal(order[0].fitted)
        if not self._astray or len(order) < SEARCH.leaders:
            return np.inf
        near = order[SEARCH.leaders - 1].fitted.chi2 + STOPPING.cost_near_best * search.temper(order[0])
        return max(near, search.unrefused(rough.effects))

    def _begin(self, tasks: Iterable[FirstLook]) -> None:
        for begun in tasks:
            if begun.state:
                self._work.learn(begun.name, begun.state)
            self._keep(begun.fits)

    def _order(self) -> list[ScoredFit]:
        return sorted(self._found.values(), key=by_cost)

    def _near(self, scored: ScoredFit) -> list[FormFit]:
        return self._work.best_near(scored.names[0])

    def _of_effects(self, names: Sequence[str]) -> list[tuple[str, State]]:
        return [(name, self._work.state(name)) for name in names]

    def _part(self, start: float, size: float) -> Report:
        return lambda fraction: self._report(start + size * fraction)

    # What is to be done next.

    @property
    def _astray(self) -> bool:
        """Whether the law so far is no place to begin."""
        return self._search.none.fitted.chi2_per_dof > STOPPING.wrong_law_chi2_per_dof and not self._settled

    def _leading(self) -> list[str]:
        """Where something is left to be explained, the effects that promise most of it."""
        work, names = self._work, list(self._effects)
        for name, state in zip(names, self._map(work.look_first, names, self._part(0.0, 0.1)), strict=True):
            work.learn(name, state)
        order = sorted(names, key=work.promise, reverse=True)[: SEARCH.first]
        clean = self._search.none.fitted.chi2_per_dof < STOPPING.explained_chi2_per_dof
        return [] if not order or (clean and work.promise(order[0]) < STOPPING.cost_near_best) else order

    def _ahead(self) -> list[str]:
        """Effects whose rough fit is among the best or not far behind."""
        order = self._order()
        if self._astray:
            order.sort(key=lambda t: t.fitted.chi2)
            near = [t for t in order if t.fitted.chi2 < STOPPING.rough_chi2_factor * order[0].fitted.chi2]
        else:
            # Fits that have not converged may still improve much.
            near = [t for t in order if t.cost < order[0].cost + _near_best(t)]
        names = {t.names[0] for t in near[: 2 * SEARCH.leaders]}
        return [name for name in self._effects if name in names]

    def _dismissed_on_the_way(self) -> list[FormFit]:
        """Rough fits that have not converged, where an effect explains much: none is discarded too early."""
        if not self._gains(self._order()):
            return []
        return [one for name in self._effects for one in self._work.on_the_way(name)]

    def _gains(self, order: Sequence[ScoredFit]) -> bool:
        return bool(order) and order[0].cost < self._search.none.cost

    def _worth_more(self) -> list[str]:
        """Effects that better starts might bring to the top, after a first pass."""
        order = self._order()
        if not self._gains(order):
            return []
        sized = [name for name, e in self._effects.items() if e.parameters]
        if not self._astray and not order[0].fails:
            # What has no place to be found is where it belongs by now.
            near = {
                t.names[0]
                for t in order
                if t.cost < min(order[0].cost + STOPPING.cost_near_best_settled, self._search.none.cost)
            }
            return [name for name in sized if name in near and has_place(self._effects[name])]
        names = [t.names[0] for t in order if t.cost < order[0].cost + STOPPING.cost_near_best]
        explained = order[0].fitted.chi2_per_dof < STOPPING.explained_chi2_per_dof
        if not explained or _may_stand_for_another(order[0]):
            plain = self._search.order_of_plain()[: SEARCH.leaders] if self._astray else []
            names = [*plain, *names, *(t.names[0] for t in order[: SEARCH.leaders])]
        return [name for name in dict.fromkeys(names) if name in sized]

    def _misplaced(self) -> list[str]:
        """Where all that lead fail, those of them whose right place may not have been among the first."""
        order = self._order()
        if not self._gains(order):
            return []
        leading = [
            t
            for t in order
            if t.cost < order[0].cost + STOPPING.cost_near_best and t.names[0] in self._effects
        ]
        if not all(t.fails for t in leading):
            return []
        return [t.names[0] for t in leading if has_place(self._effects[t.names[0]])]


def _near_best(scored: ScoredFit) -> float:
    """Cost above the best one's up to which a rough fit is followed to its end."""
    return STOPPING.cost_near_best_settled if scored.fitted.converged else STOPPING.cost_near_best


def _may_stand_for_another(scored: ScoredFit) -> bool:
    """Whether it is another law, or larger than is plausible: what it explains may be another effect's."""
    return bool(scored.too_large) or any(e.replaces_law for e in scored.fitted.effects)
