"""A first look at an effect beside a fit: what one linear step promises, from each of its starts."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.response.response import Response
from fitting.diagnosis.several.of_files import inner_of
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.thresholds import STARTS
from fitting.effects.base import Effect
from fitting.effects.given import Points
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw

Start = tuple[float, Array]
"""The chi-square that a start may gain, and its unknowns; zero where a linear step cannot tell."""

_SMALL = 0.02
"""Of a start's strength: there every effect is linear."""
_LEAST_BEND, _ALMOST = 30.0, 0.5
"""Chi-square that a step leaves where its bend is in the way; its share of what is felt. A choice."""
_NEXT_TO = 0.06
"""In ln f: frequencies that are no further apart are one place. Three steps of a fixture's grid; a choice."""
_LARGEST = 20.0
"""Times a start's strength: no step is trusted further. A choice."""


def look(
    problem: DiagnosisProblem,
    evidence: Evidence,
    before: Refitted,
    effect: Effect,
    *,
    again: bool = False,
    plain: Response | None = None,
) -> list[Start]:
    """Starts of an effect, scaled by a linear step, with the chi-square each may gain; best first.

    `plain` is the coarse response without it, where several effects are looked at beside one fit. `again`: a
    step of the size that the first one ends with tells once more, where there is no place to be found.
    """
    response = response_of(problem, [*before.effects, effect], problem.coarse)
    plain = plain or response_of(problem, before.effects, problem.coarse)
    found = promising(response, plain, problem.points, evidence, before)
    if not again or has_place(effect) or not effect.parameters:
        return found
    told = [u for promise, u in found[: STARTS.followed] if promise > 0]
    steps = promising(response, plain, problem.points, evidence, before, told)
    return sorted([*found, *steps], key=lambda f: -f[0])


def promising(
    response: Response,
    plain: Response,
    points: Points,
    evidence: Evidence,
    before: Refitted,
    starts: Sequence[Array] | None = None,
) -> list[Start]:
    """The same of the last effect of `response`; `plain` is without it. Its own starts are the default.

    Where law and stated numbers could do most of a full step, its nonlinearity hides the rest, which only the
    effect can do; then a small step from the effect's own starts is looked at too.

    Shapes: `points` (points,) each; `starts` (parameters,) each.
    """
    effect = response.effects[-1]
    v = plain.velocity(before.law, before.u)
    step = _LinearStep(effect, evidence, before, v, effect.limits(response.plate))
    each = effect.starts(response.plate, points) if starts is None else starts
    moved = moves(response, before.law, before.u, each, v)
    felt = [step.felt(u, m) for u, m in zip(each, moved, strict=True)]
    found = [step.scaled(u, one) for u, one in zip(each, felt, strict=True)]
    if starts is None and effect.parameters and not before.effects and not by_adjoint(effect):
        small = _directions(effect, [u for u, one in zip(each, felt, strict=True) if step.hides(one)])
        slope = slopes(response, before.law, before.u, small, v)
        told = [step.scaled(u, step.felt_of_slope(u, m)) for u, m in zip(small, slope, strict=True)]
        found += [one for one in told if one is not None and one[0] > STARTS.least_promise]
    return _apart(effect, sorted((one for one in found if one is not None), key=lambda f: -f[0]))


def _apart(effect: Effect, starts: Sequence[Start]) -> list[Start]:
    """Starts, given best first, in the order in which they are followed.

    Of an effect with a frequency, by turns the best start of a cluster of close frequencies and one of the
    others: from close frequencies most fits, but not all, end in the same place. Of an effect that has a
    place too, each place once before any comes again: its frequency is easily seen, its place is not.
    """
    found = [q.neutral is None and not q.fixed for q in effect.parameters]
    frequency, place = (
        [to_be and q.logarithmic == log for to_be, q in zip(found, effect.parameters, strict=True)]
        for log in (True, False)
    )
    if not any(frequency):
        return list(starts)
    if any(place):
        been = Counter[tuple[float, ...]]()
        turn = np.empty(len(starts))
        for k, (_, u) in enumerate(starts):
            turn[k] = been[tuple(u[place])]
            been[tuple(u[place])] += 1
        return [starts[k] for k in np.argsort(turn, kind="stable")]
    ln = np.log([u[frequency.index(True)] for _, u in starts])
    led = np.array([np.any(np.abs(ln[:k] - x) < _NEXT_TO) for k, x in enumerate(ln)], bool)
    # The first, the second, ... of its kind.
    turn = np.where(led, np.cumsum(led), np.cumsum(~led))
    return [starts[k] for k in np.lexsort((led, turn))]


def _directions(effect: Effect, starts: Sequence[Array]) -> list[Array]:
    """Those of some starts that differ in more than their strength: a slope is all of it."""
    found: dict[tuple[float, ...], Array] = {}
    for u in starts:
        kept = effect.scaled(u, 2.0) == u
        one_size = np.sum(~kept) == 1
        found.setdefault(tuple(u[kept] if one_size else u), u)
    return list(found.values())


@dataclass(frozen=True)
class _LinearStep:
    """How far an effect goes beside a fit, were what it changes linear in its strength."""

    effect: Effect
    evidence: Evidence
    before: Refitted
    velocity: Complex
    """Of the fit, by the response that is looked with. Shape (points,)."""
    limits: tuple[Array, Array]

    def felt(self, u: Array, moved: Complex) -> Array:
        """What readings and bare plate feel of it, in standard deviations. Shape (rows,)."""
        rows = self.evidence.jacobian(self.velocity, moved[None])[:, 0]
        return np.concatenate([rows, self.evidence.bare_moves(self.effect, u)])

    def felt_of_slope(self, u: Array, slope: Complex) -> Array:
        """The same to first order in its strength. Shape (rows,)."""
        rows = self.evidence.jacobian(self.velocity, slope[None])[:, 0]
        less, more = (self.evidence.bare_moves(self.effect, one) for one in _weak(self.effect, u))
        return np.concatenate([rows, (more - less) / _SMALL])

    def left(self, felt: Array) -> Array:
        """What nothing that is fitted does of it. Shape of the residuals."""
        Q, s = self.before.feels, np.zeros(len(self.before.residuals))
        # What is known beforehand does not feel the effect.
        s[: len(felt)] = felt
        return np.asarray(s - Q @ (Q.T @ s))

    def hides(self, felt: Array) -> bool:
        """Whether a step is almost another's work, and yet leaves much: it bends."""
        left = self.left(felt)
        size = float(left @ left)
        return _LEAST_BEND < size < _ALMOST * float(felt @ felt)

    def scaled(self, u: Array, felt: Array) -> Start | None:
        """From a start, where so much is felt at its strength; None where that says nothing."""
        r, s = self.before.residuals, self.left(felt)
        size = float(s @ s)
        if not np.isfinite(size) or size <= 0:
            return None
        a = -float(r @ s) / size
        if not self.effect.parameters:
            return float(r @ r - (r + s) @ (r + s)), u
        if a <= 0 and self._one_sided:
            return 0.0, u
        at = self.effect.scaled(u, np.clip(a, -_LARGEST, _LARGEST) or 1e-3)
        return a**2 * size, np.clip(at, *self.limits)

    @property
    def _one_sided(self) -> bool:
        sized = [q for q in self.effect.parameters if q.says_how_much]
        return any(q.neutral is not None and not q.lower < q.neutral < q.upper for q in sized)


def slopes(response: Response, law: CoreLaw, known: Array, starts: Sequence[Array], v: Complex) -> Complex:
    """How the phasors move from `v` to first order, at the strength of each start. Shape (starts, points)."""
    effect = response.effects[-1]
    if by_adjoint(effect) or not effect.parameters:
        return moves(response, law, known, starts, v)
    weak, twice = ([_weak(effect, u)[k] for u in starts] for k in (0, 1))
    return np.asarray((moves(response, law, known, twice, v) - moves(response, law, known, weak, v)) / _SMALL)


def _weak(effect: Effect, u: Array) -> tuple[Array, Array]:
    """Two small strengths: interpolated otherwise than without the effect, zero has an error of its own."""
    return effect.scaled(u, _SMALL), effect.scaled(u, 2 * _SMALL)


def moves(response: Response, law: CoreLaw, known: Array, starts: Sequence[Array], v: Complex) -> Complex:
    """How the phasors move from `v` as the last effect comes in from each start. Shape (starts, points)."""
    effect = response.effects[-1]
    if by_adjoint(effect):
        # Many places to be tried: one adjoint serves all of them.
        return response.signatures(law, known, starts)
    with np.errstate(all="ignore"):
        return np.array([_moved(response, law, np.concatenate([known, u]), v) for u in starts])


def _moved(response: Response, law: CoreLaw, u: Array, v: Complex) -> Complex:
    try:
        return response.velocity(law, u) - v
    except OutsideModel:
        # A table's modes may be more than such a structure has: that start is not followed.
        return np.full_like(v, np.nan)


def by_adjoint(effect: Effect) -> bool:
    """Whether what an effect moves is found to first order, for all of its places at once."""
    return has_place(effect) and type(inner_of(effect)).change is not Effect.change


def has_place(effect: Effect) -> bool:
    """Whether an unknown has no neutral value: where it sits, or at which frequency, is to be found."""
    return any(q.neutral is None and not q.fixed for q in effect.parameters)
