"""Explanations that may stand in for a cause that is in no catalogue (docs/decisions/0029)."""

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.thresholds import VERDICT
from fitting.effects.base import Effect, EffectParameter
from fitting.widened.enriched_plate import EnrichedReducedPlate

_AT = 1e-6
"""Share of a limit: nearer to it, a fit would go on. Of the limit itself, unlike in `verdict.kin` and
`verdict.stage`: only limits away from where the effect is absent are asked, and not all have another beside
them that is finite."""


def stands_in(problem: DiagnosisProblem, fitted: Refitted) -> str:
    """Why an explanation may stand in for something that is not known: a clause; empty where it cannot."""
    effects = fitted.effects
    if supposes_too_much(fitted):
        return "so many things at once come near to anything"
    if len(effects) > 1 and any(e.of_a_segment for e in effects):
        return "what one segment alone shows, beside another effect, may be of anything"
    for effect in effects:
        if not effect.shows(problem.points, problem.resonances, fitted.of(effect)):
            return f"no measured points show a {effect.name} by themselves"
    name = too_large(fitted, problem.plate)
    return f"{name} would be larger than is plausible" if name else ""


def supposes_too_much(fitted: Refitted) -> bool:
    """Whether it is more things at once than can be told from a cause that is in no catalogue."""
    return sum(e.causes for e in fitted.effects) > VERDICT.causes


def unsized(fitted: Refitted) -> bool:
    """Whether one of several effects has no size that the data tell from nothing.

    A second effect of no significant size may only make up for what the first one's formula lacks.
    """
    return len(fitted.effects) > 1 and has_no_size(fitted)


def has_no_size(fitted: Refitted) -> bool:
    """Whether one of its effects, or the only one, has no size that the data tell from nothing."""
    errors = fitted.unknown_errors()
    for effect, own in fitted.each():
        sized = [
            _is_sized(q, float(value), float(error))
            for q, value, error in zip(effect.parameters, fitted.u[own], errors[own], strict=True)
            if q.says_how_much
        ]
        if sized and not any(sized):
            return True
    return False


def _is_sized(q: EffectParameter, value: float, error: float) -> bool:
    """`error` of its logarithm where it has one. One at a limit has none, and is there."""
    assert q.neutral is not None
    if not np.isfinite(error):
        return value != q.neutral
    return error < 1 / VERDICT.sized if q.logarithmic else abs(value - q.neutral) > VERDICT.sized * error


def too_large(fitted: Refitted, plate: EnrichedReducedPlate) -> str:
    """Which of its effects asks for more than is plausible; empty where none does."""
    return next((e.name for e in fitted.effects if asks_for_more(e, fitted.of(e), plate)), "")


def asks_for_more(effect: Effect, u: Array, plate: EnrichedReducedPlate) -> bool:
    """Whether a size ends at its plausible limit, away from where the effect is absent, or is beyond it.

    `u` of shape (parameters,).
    """
    if effect.is_beyond(u):
        return True
    for q, value, low, high in zip(effect.parameters, u, *effect.limits(plate), strict=True):
        if q.neutral is None or q.fixed or q.complete:
            continue
        absent = np.clip(q.neutral, low, high)
        ends = [end for end in (low, high) if np.isfinite(end) and end != absent]
        if any(abs(value - end) <= _AT * abs(end) for end in ends):
            return True
    return False
