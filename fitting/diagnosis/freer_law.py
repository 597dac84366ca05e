"""A law that bends as far as the data ask for.

How far materials lie off a formula is taken from a handful (`fitting.bent_law`); one may lie further. With xi
the whitened bend that was found, k numbers, and C their covariance, a wider prior makes data likelier where

    xi . xi > gamma,   gamma = k - tr C

gamma being how many of them the data determine (MacKay, Neural Computation 4, 1992, p. 415).
"""

from dataclasses import replace

import numpy as np

from fitting.bent_law import BentLaw
from fitting.diagnosis.begin import Begun
from fitting.diagnosis.marginal import cost
from fitting.diagnosis.refitted import Refitted
from fitting.diagnosis.usual_law import polished

_TIMES = 2.0
"""From one width of the prior to the next: their evidence is flat between. A choice."""
_STEPS = 3
"""Widths tried at most: eight times the usual one, 20 % in G' and 36 % in eta, is no law of that form."""
_RARE = 2 * np.log(10.0)
"""Of -2 ln Z, that the first wider one has to gain: one material in ten is expected to need it. A choice."""


def loosened(begun: Begun) -> Begun:
    """The same, its fit with the freedom that makes the data most likely: the usual one, or more."""
    best, least = begun.none, _RARE
    for _ in range(_STEPS):
        if not _asks_for_more(best):
            break
        assert isinstance(best.law, BentLaw)
        wider = polished(begun.problem, (), begun.evidence, best.law.freer(_TIMES), best.u)
        if cost(wider, begun.problem.plate) > cost(best, begun.problem.plate) - least:
            break
        best, least = wider, 0.0
    return replace(begun, none=best)


def _asks_for_more(fitted: Refitted) -> bool:
    """Whether a wider prior of the bend would make the data more likely, to first order."""
    law = fitted.law
    if not isinstance(law, BentLaw) or not fitted.noise_known:
        return False
    bend = slice(len(law.plain.names), len(law.names))
    xi = np.log(law.values[bend])
    gamma = law.bend_count - float(np.trace(fitted.covariance[bend, bend]))
    return float(xi @ xi) > gamma
