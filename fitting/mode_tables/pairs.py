"""Two effects together on tables of modes, where there is one.

A table has few numbers: pairs are ranked by marginal likelihood as single effects are, and named only where
they predict modes that were left out better than no effect does.
"""

from collections.abc import Sequence

import numpy as np

from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.search.catalogue_search import ScoredFit, by_cost
from fitting.diagnosis.thresholds import STOPPING
from fitting.effects.base import Effect
from fitting.mode_tables.explaining import Explaining
from fitting.progress import Report

LEADERS = 3
"""Single effects that a second one is looked for beside."""
FOLLOWED, FOLLOWED_A_LEADER = 8, 4
"""Pairs that are fitted, and of those, with one leader: each has its say. Choices, for time."""


def called_for(work: Explaining, none: ScoredFit, singles: Sequence[ScoredFit]) -> bool:
    """Whether the best single effect is more than a chance find."""
    known = work.begun.evidence.scale_known
    return known and bool(singles) and none.cost - singles[0].cost > STOPPING.least_gain_in_cost


def best_pairs(
    work: Explaining, singles: Sequence[ScoredFit], effects: Sequence[Effect], report: Report
) -> list[ScoredFit]:
    """Second effects beside the leading single ones; the effects of the best pair alone, too.

    `singles` best first. One of every explanation, best first.
    """
    beside = [e for e in effects if not e.replaces_law]
    leaders = [t for t in singles if not any(e.replaces_law for e in t.fitted.effects)][:LEADERS]
    asked = [
        (t, form, starts)
        for t in leaders
        for e in beside
        if e.name not in t.names
        for form in work.forms(e)
        if (starts := work.starts(form, t.fitted))
    ]
    expected = [t.fitted.chi2 - starts[0][0] for t, _, starts in asked]
    chosen: dict[frozenset[str], int] = {}
    of_leader: dict[int, int] = {}
    for k in np.argsort(expected):
        leader, form, _ = asked[k]
        if len(chosen) < FOLLOWED and of_leader.get(id(leader), 0) < FOLLOWED_A_LEADER:
            of_leader[id(leader)] = of_leader.get(id(leader), 0) + 1
            chosen.setdefault(frozenset((*leader.names, form.name)), int(k))
    found: dict[frozenset[str], ScoredFit] = {}
    for n, k in enumerate(chosen.values()):
        leader, form, starts = asked[k]
        fits = work.fits(form, leader.fitted, starts)
        for f in (*fits, *(other for one in fits for other in _beyond(work, one))):
            scored = work.scored(f)
            known = found.get(frozenset(scored.names))
            if work.determined(f) and (known is None or scored.cost < known.cost):
                found[frozenset(scored.names)] = scored
        report((n + 1) / len(chosen))
    ranked = sorted(found.values(), key=by_cost)
    return [*ranked, *(one for pair in ranked[:1] for one in _alone(work, pair))]


def _beyond(work: Explaining, pair: Refitted) -> list[Refitted]:
    """Two factors on numbers fitted again from their reciprocals.

    Of faces that are alike there is a valley on the other side too.
    """
    each = [q for e in pair.effects for q in e.parameters]
    if any(q.neutral != 1 or q.fixed for q in each):
        return []
    u = pair.u.copy()
    u[pair.stated :] = np.clip(1 / u[pair.stated :], *np.array([(q.lower, q.upper) for q in each]).T)
    fitted = work.ended(pair.effects, pair.law, u)
    return [] if fitted is None else [fitted]


def _alone(work: Explaining, pair: ScoredFit) -> list[ScoredFit]:
    """Each effect of a pair fitted alone from where the pair left it."""
    both = pair.fitted
    fits = [work.ended([e], both.law, np.concatenate([both.z, both.of(e)])) for e in both.effects]
    return [work.scored(f) for f in fits if f is not None]
