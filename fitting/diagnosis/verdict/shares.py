"""Probabilities of explanations, and which of them are the group that holds 95 %."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.marginal import probabilities
from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.thresholds import VERDICT


def shares_of(every: Sequence[ScoredFit]) -> Array:
    """Probabilities, where what no point shows by itself shares with what nothing refuses.

    A cause that is in no catalogue is fitted by what bends most freely, and far better than by the rest. So
    what may stand in for it keeps `VERDICT.stand_in` of what both have, the others share theirs by their
    costs; that there is an effect at all is not in doubt. Shape (explanations,).
    """
    costs = np.array([t.cost for t in every])
    p = probabilities(costs)
    unseen = np.array([bool(t.stands_in) for t in every])
    others = np.array([bool(t.names) and not t.fails and not t.stands_in for t in every])
    both = float(p[unseen | others].sum())
    if not others.any() or p[unseen].sum() <= VERDICT.stand_in * both:
        return p
    p[unseen] *= VERDICT.stand_in * both / p[unseen].sum()
    p[others] = (1 - VERDICT.stand_in) * both * probabilities(costs[others])
    return p


def holding(shares: Sequence[float]) -> int:
    """How many of the first hold 95 %, the likeliest first."""
    before = np.cumsum(shares) - shares
    return int(np.sum(before < VERDICT.credible))


def group_of(ranked: Sequence[tuple[ScoredFit, float]]) -> tuple[tuple[ScoredFit, float], ...]:
    """The first of them that hold 95 %, their shares scaled to one."""
    found = ranked[: holding([share for _, share in ranked])]
    total = sum(share for _, share in found)
    return tuple((t, share / total) for t, share in found)
