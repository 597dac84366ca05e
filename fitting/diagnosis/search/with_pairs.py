"""Single effects, and two together where one gains anything: all explanations that may matter."""

from collections.abc import Sequence

from fitting.diagnosis.search.catalogue_search import ScoredFit, Search, best_of_each
from fitting.diagnosis.search.pairs import Pairs
from fitting.diagnosis.thresholds import PAIRS
from fitting.progress import Report

_ROUNDS = 2
"""How often pairs are looked for, each time about the best single effect so far. A bound on time."""


def with_pairs(
    search: Search, singles: Sequence[ScoredFit], report: Report
) -> tuple[list[ScoredFit], list[ScoredFit]]:
    """Single effects and pairs, best first; once more where a pair has led to a better one that suffices."""
    alone, pairs = list(singles), list[ScoredFit]()
    for k in range(_ROUNDS):
        found = _pairs(search, alone, _part(report, k))
        before = alone[:1]
        alone = best_of_each([*alone, *(t for t in found if len(t.names) == 1)])
        pairs = best_of_each([*pairs, *(t for t in found if len(t.names) > 1)])
        if alone[:1] == before or not search.suffices(alone[0]) or alone[0].cost > pairs[0].cost:
            break
    return alone, pairs


def _pairs(search: Search, singles: Sequence[ScoredFit], report: Report) -> list[ScoredFit]:
    """Two effects, where one leaves something or only another law explains it all."""
    if not singles or not search.evidence.scale_known:
        return []
    best = singles[0]
    if search.evidence.count < PAIRS.data_per_parameter * (best.fitted.parameter_count + 2):
        return []
    if search.none.cost < best.cost:
        return []
    wide = not search.suffices(best)
    if not wide and search.left_by(best) < PAIRS.nothing_left_chi2_per_dof:
        return []
    return Pairs(search).best(singles, report, wide=wide)


def _part(report: Report, k: int) -> Report:
    return lambda x: report((k + x) / _ROUNDS)
