"""Explanations as a search leaves them, to be weighed."""

from types import SimpleNamespace

from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.thresholds import VERDICT
from fitting.diagnosis.verdict.judgement import judge
from fitting.effects import CATALOGUE


def scored(*names, cost, fails=False, stands_in="", too_large="", tolerances=0.5, unsized=False):
    fitted = SimpleNamespace(effects=tuple(CATALOGUE[name] for name in names))
    checks = {"size": 0.5, "tolerances": tolerances, "signs": 0.1 * VERDICT.check_level if fails else 0.5}
    return ScoredFit(fitted, cost, checks, stands_in, too_large, unsized)


def judged(none, *scored_fits, off=None):
    return judge(
        none,
        scored_fits,
        held_out=lambda one: (off or {}).get(one.names, 1.0),
    )


POOR_NONE = scored(cost=1000.0, fails=True)
