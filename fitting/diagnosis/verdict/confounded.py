"""Causes that the law itself imitates: the data can neither name them nor rule them out.

A shear pair's readings depend on modulus over mass alone, the rubber's own inertia apart: a mass that is
stated wrongly leaves nothing, and moves the law by as much. Then `none` would say more than the data do.
"""

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.marginal import expected_size
from fitting.diagnosis.inference.refit import evaluated
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.response.response import Response
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.verdict.judgement import Judgement
from fitting.diagnosis.verdict.names import NONE
from fitting.effects.base import Effect
from fitting.nuisances.nuisance import Nuisance
from fitting.stated.tolerances import OF_THEORY

HIDDEN = 1.0
"""Standard deviations that a cause of the usual size may leave and still be hidden."""
MOVES = 1.0
"""Standard errors of the law's modulus from which a hidden cause matters."""


def last_word(kinds: Collection[str]) -> Callable[[Search, Judgement], Judgement] | None:
    """What has the last word on a verdict about specimens of these kinds; None for plates and beams.

    Of a plate's or a beam's stated numbers its resonances say which they are, and what still hides in the law
    is in the band, of one file or of several. Of a mass on rubber all that is read is one number over
    another.
    """
    return in_light_of_the_law if "shear-pair" in kinds else None


def in_light_of_the_law(search: Search, judgement: Judgement) -> Judgement:
    """`ambiguous` in the place of `none` where a usual cause would hide in the law and move it."""
    if judgement.verdict != "none":
        return judgement
    hidden = [e for e in search.effects if _hides(search, e)]
    if not hidden:
        return judgement
    best = max(hidden, key=lambda e: e.chance)
    scored = _as_absent(search, best)
    names = tuple(e.name for e in hidden)
    note = note_of_imitated(names, "the response")
    return replace(
        judgement, verdict="ambiguous", accepted=scored, equivalent={best.name: (*names, NONE)}, note=note
    )


def note_of_imitated(names: Sequence[str], read: str) -> str:
    """What is said of effects that the law imitates; `read` is what the data are of, with its article."""
    return (
        f"{' and '.join(names)} cannot be told from the core's modulus by these data: what one does to "
        f"{read} the other does too. The law found is that of what is stated."
    )


def _as_absent(search: Search, effect: Effect) -> ScoredFit:
    response = response_of(search.problem, [effect])
    return search.judged(absent_fit(response, search.evidence, search.none.fitted, effect))


def absent_fit(response: Response, evidence: Evidence, none: Refitted, effect: Effect) -> Refitted:
    """The fit without effects, `effect` beside it at its neutral value; `response` is with that effect."""
    neutral = [0.0 if q.neutral is None else q.neutral for q in effect.parameters]
    return evaluated(response, evidence, none.law, np.concatenate([none.z, neutral]))


def _hides(search: Search, effect: Effect) -> bool:
    if not _one_size(effect):
        return False
    problem = search.problem
    absent = _as_absent(search, effect).fitted
    return hides(search.none.fitted, absent, problem.points.omega, problem.nuisances.each)


def _one_size(effect: Effect) -> bool:
    sized = [q for q in effect.parameters if not q.fixed]
    return len(sized) == 1 and sized[0].neutral is not None and not sized[0].logarithmic


def hides(none: Refitted, absent: Refitted, omega: Array, stated: Sequence[Nuisance] = ()) -> bool:
    """Whether the law can do what an effect of one size would; `absent` has it last, at its neutral value.

    `omega` in rad/s, shape (points,). `stated`: the stated numbers of `none`.
    """
    (effect,) = absent.effects
    if not _one_size(effect):
        return False
    law, J = none.law, absent.jacobian
    step = expected_size(next(q for q in effect.parameters if not q.fixed)) * J[:, -1]
    widths = law.search_widths
    loose = np.zeros((len(widths), J.shape[1] - 1))
    loose[:, : len(widths)] = np.diag(1 / widths)
    A = np.vstack([J[:, :-1], loose])
    moved, *_ = np.linalg.lstsq(A, -np.append(step, np.zeros(len(widths))), rcond=None)
    left = A @ moved + np.append(step, np.zeros(len(widths)))
    if np.linalg.norm(left) > HIDDEN:
        return False
    by_log = (law.jacobian(omega) * law.values[:, None] / law.modulus(omega)).real
    # What a theory leaves open widens the law's band and says nothing of a cause beside it.
    left_open = np.flatnonzero([n.kind in OF_THEORY for n in stated])
    C = _held(none.covariance, len(law.names) + left_open, len(law.names))
    return bool(_rms(by_log.T @ moved[: len(law.names)]) > MOVES * _rms(np.sqrt(_diagonal(by_log, C))))


def _held(C: Array, at: NDArray[np.intp], count: int) -> Array:
    """Covariance of the first unknowns, others held. Shape (count, count)."""
    by = C[:count, at]
    return np.asarray(C[:count, :count] - by @ np.linalg.solve(C[np.ix_(at, at)], by.T))


def _diagonal(rows: Array, C: Array) -> Array:
    return np.asarray(np.maximum(np.einsum("ip,ij,jp->p", rows, C, rows), 0))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
