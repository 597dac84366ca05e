"""A law that bends as far as the data ask for.

How far materials lie off a formula is taken from a handful (`fitting.laws.bent_law`); one may lie further.
With xi the whitened bend that was found, k numbers, and C their covariance, a wider prior makes data
likelier where

    xi . xi > gamma,   gamma = k - tr C

gamma being how many of them the data determine (MacKay, Neural Computation 4, 1992, p. 415).
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fitting.diagnosis.inference.begin import Begun
from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.inference.usual_law import polished
from fitting.diagnosis.thresholds import VERDICT
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw

_TIMES = 2.0
"""From one width of the prior to the next: their evidence is flat between. A choice."""
_STEPS = 3
"""Widths tried at most: eight times the usual one, 20 % in G' and 36 % in eta, is no law of that form."""


def loosened(begun: Begun) -> Begun:
    """The same, its fit with the freedom that makes the data most likely: the usual one, or more."""

    def again(law: CoreLaw, none: Refitted) -> Refitted:
        return polished(begun.problem, (), begun.evidence, law, none.u)

    none = as_free_as_asked(begun.none, again, lambda fitted: cost(fitted, begun.problem.plate))
    return begun if none is begun.none else replace(begun, none=none)


def as_free_as_asked(
    fitted: Refitted, again: Callable[[CoreLaw, Refitted], Refitted], worth: Callable[[Refitted], float]
) -> Refitted:
    """A fit with the freedom of its law that makes the data most likely; itself where that is what it has.

    `again` fits with another law from where a fit ended; `worth` is its -2 ln Z.
    """
    best, least = fitted, VERDICT.freer_law_cost
    for _ in range(_STEPS):
        if not _asks_for_more(best):
            break
        assert isinstance(best.law, BentLaw)
        wider = again(best.law.freer(_TIMES), best)
        if worth(wider) > worth(best) - least:
            break
        best, least = wider, 0.0
    return best


def freedom_of(law: CoreLaw) -> float:
    """Times the usual one; 1 for a law that may not bend."""
    return law.freedom if isinstance(law, BentLaw) else 1.0


def _asks_for_more(fitted: Refitted) -> bool:
    """Whether a wider prior of the bend would make the data more likely, to first order."""
    law = fitted.law
    if not isinstance(law, BentLaw) or not fitted.noise_known:
        return False
    bend = slice(len(law.plain.names), len(law.names))
    xi = np.log(law.values[bend])
    gamma = law.bend_count - float(np.trace(fitted.covariance[bend, bend]))
    return float(xi @ xi) > gamma
