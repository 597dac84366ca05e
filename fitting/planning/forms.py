"""Forms of an explanation that one sweep hardly tells apart and another measurement may.

A clamp line that is elsewhere: was the spot measured from it or not? At one spot a gain or a modulus makes up
for it. A diagnosis keeps the form that fits best; a forecast that knew no other would be too sure.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.diagnosis.inference.marginal import cost, probabilities
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.inference.usual_law import polished
from fitting.diagnosis.several.of_files import copies_of, inner_of
from fitting.diagnosis.verdict.result import Rivals
from fitting.effects.base import Effect

_LEAST = 0.02
"""Share below which a form is not asked."""

Weighted = list[tuple[Refitted, float]]


def forms_of(rivals: Rivals, fitted: Refitted) -> Weighted:
    """All forms of one explanation, the given one first, and their shares of it."""
    every = [fitted]
    for u in _others(rivals, fitted):
        every.append(polished(rivals.problem, fitted.effects, rivals.evidence, fitted.law, u))
    if len(every) == 1:
        return [(fitted, 1.0)]
    plate = rivals.problem.plate
    shares = probabilities(np.array([cost(f, plate, rivals.temper) for f in every]))
    kept = [(f, float(p)) for f, p in zip(every, shares, strict=True) if f is fitted or p > _LEAST]
    whole = sum(p for _, p in kept)
    return [(f, p / whole) for f, p in kept]


def _others(rivals: Rivals, fitted: Refitted) -> Iterator[Array]:
    """Unknowns of the other forms, everything else as it was fitted. Shape of `fitted.u` each."""
    for effect, part in fitted.each():
        inner = inner_of(effect)
        at = np.flatnonzero([q.fixed for q in inner.parameters])
        for how in _ways(inner, at, rivals):
            u = fitted.u.copy()
            for own in copies_of(effect):
                u[part][own[at]] = how
            if not np.array_equal(u, fitted.u):
                yield u


def _ways(inner: Effect, at: NDArray[np.intp], rivals: Rivals) -> list[tuple[float, ...]]:
    """What its starts have for the numbers that no fit moves."""
    if not len(at):
        return []
    starts = inner.starts(rivals.problem.plate, rivals.problem.points)
    return list(dict.fromkeys(tuple(u[at].tolist()) for u in starts))
