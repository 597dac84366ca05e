"""What speaks against an explanation by itself, however much likelier than others it is."""

from collections.abc import Callable

from fitting.diagnosis.checks.predictive import weakest
from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.search.stand_in import supposes_too_much
from fitting.diagnosis.thresholds import VERDICT
from fitting.digits import seldom

HeldOut = Callable[[ScoredFit], float]
"""Error of an explanation over noise on data it has not seen, NaN where there are none."""


def against_by_checks(best: ScoredFit) -> str:
    """What the weakest of its checks says against an explanation, after its name; empty for nothing."""
    worst = weakest(best.checks)
    if worst is None or worst[1] >= VERDICT.check_level:
        return ""
    return f"would leave such data {seldom(worst[1])} ({worst[0]})"


def against(none: ScoredFit, best: ScoredFit, held_out: HeldOut) -> str:
    """Why an explanation is none; empty where nothing speaks against it."""
    if why := against_by_checks(best):
        return why
    if best.too_large and len(best.names) > 1:
        # One of two that goes as far as it may is what a third would be, that is in no catalogue.
        return f"has more of {best.too_large} than is plausible"
    if supposes_too_much(best.fitted):
        return "supposes three things at once, which come near to anything"
    if _predicts_nothing(none, best, held_out):
        return "does not predict the segments it has not seen"
    return ""


def _predicts_nothing(none: ScoredFit, best: ScoredFit, held_out: HeldOut) -> bool:
    """Whether data that were held out speak against an explanation that fits by another law's freedom."""
    if not none.fails or not any(e.replaces_law for e in best.fitted.effects):
        return False
    off = held_out(best)
    return off > VERDICT.poor and off > VERDICT.hardly_better * held_out(none)
