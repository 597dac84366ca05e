"""What effects of the catalogue would change of the readings, to first order in how strong they are."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.inference.marginal import expected_size
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.response.response import Response
from fitting.diagnosis.search.looks import has_place, slopes
from fitting.diagnosis.several.responses import response_of
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import Points
from fitting.laws import CoreLaw

_FEW = 12
"""Starts of an effect that are looked at: of a grid of places, so many spread over it."""


@dataclass(frozen=True)
class Signature:
    """One effect from some of its starts; what it changes of the velocity is linear in its strength."""

    effect: Effect
    starts: tuple[Array, ...]
    """Its unknowns at each."""
    moves: Complex
    """Changes of the velocity there, in m/s. Shape (starts, points)."""

    def sized(self, start: int) -> int | None:
        """Which of its unknowns says how strong it is; None for an effect that is there or not."""
        u, found = (
            self.starts[start],
            [k for k, q in enumerate(self.effect.parameters) if q.says_how_much],
        )
        return max(found, key=lambda k: _strength(self.effect.parameters[k], float(u[k])), default=None)

    @property
    def has_place(self) -> bool:
        """Whether starts are places, or frequencies, any of which it may be at."""
        return has_place(self.effect)

    @property
    def freedom(self) -> int:
        """How many unknowns a fit of it moves; one where it has none."""
        return max(1, sum(not q.fixed for q in self.effect.parameters))

    def size(self, start: int, strength: float) -> float | None:
        """Of the unknown that says how strong it is, `strength` times as strong as from a start."""
        k = self.sized(start)
        if k is None:
            return None
        return float(self.effect.scaled(self.starts[start], strength)[k])

    def expected(self, start: int) -> float:
        """How strong it is expected to be where a laboratory has it, in strengths of a start."""
        k = self.sized(start)
        if k is None:
            return 1.0
        q, u = self.effect.parameters[k], float(self.starts[start][k])
        if q.logarithmic:
            # As likely anywhere in its logarithm: the middle.
            usual = float(np.sqrt(q.lower * q.upper))
            return u / usual if np.isinf(_neutral(q)) else usual / u
        return float(expected_size(q) / max(abs(u - _neutral(q)), 1e-300))

    def chance_above(self, start: int, strength: float) -> float:
        """Chance that it is stronger than that, where it is there at all: by its prior (`marginal`)."""
        k = self.sized(start)
        if k is None:
            return float(strength <= 1)
        q, size = self.effect.parameters[k], self.size(start, strength)
        assert size is not None
        if q.logarithmic:
            share = np.log(np.clip(size, q.lower, q.upper) / q.lower) / np.log(q.upper / q.lower)
            return float(share if np.isinf(_neutral(q)) else 1 - share)
        # Cauchy's, of that width.
        return float(1 - 2 / np.pi * np.arctan(abs(size - _neutral(q)) / expected_size(q)))


def _strength(q: EffectParameter, u: float) -> float:
    """Of one unknown, in its expected sizes; one with a logarithm before all others."""
    return np.inf if q.logarithmic else abs(u - _neutral(q)) / expected_size(q)


def _neutral(q: EffectParameter) -> float:
    assert q.neutral is not None
    return q.neutral


def signatures_of(
    problem: DiagnosisProblem,
    law: CoreLaw,
    known: Array,
    effects: Sequence[Effect],
    report: Callable[[float], None] = lambda share: None,
    beside: Sequence[Effect] = (),
) -> list[Signature]:
    """Of the effects that the points of `problem` can be asked about, `beside` some that are there.

    `known` are the stated numbers and the unknowns of these. Shape (unknowns,).
    """
    able = [
        e
        for e in effects
        if e.passes_for_a_law(problem.points) or e.objection(problem.points, problem.plate) is None
    ]
    return signatures_in(
        lambda some: response_of(problem, some, problem.coarse),
        problem.points,
        *(law, known, able),
        report=report,
        beside=beside,
    )


def signatures_in(
    responses: Callable[[Sequence[Effect]], Response],
    points: Points,
    law: CoreLaw,
    known: Array,
    effects: Sequence[Effect],
    *,
    report: Callable[[float], None] = lambda share: None,
    beside: Sequence[Effect] = (),
) -> list[Signature]:
    """The same, where `responses` gives what is read under some effects; `points` may be asked of all.

    Shape of `known` (unknowns,).
    """
    plain = responses(beside).velocity(law, known)
    found = []
    for done, effect in enumerate(effects):
        report(done / len(effects))
        if judged_elsewhere(effect):
            continue
        response = responses([*beside, effect])
        starts = effect.starts(response.plate, points)
        starts = [starts[k] for k in np.unique(np.linspace(0, len(starts) - 1, _FEW).astype(int))]
        moved = slopes(response, law, known, starts, plain)
        kept = [
            k
            for k, m in enumerate(moved)
            if np.all(np.isfinite(m)) and np.any(np.abs(m) > 1e-12 * np.abs(plain))
        ]
        if kept:
            found.append(Signature(effect, tuple(starts[k] for k in kept), moved[kept]))
    return found


def judged_elsewhere(effect: Effect) -> bool:
    """What takes the law's place, or shows in the channels by itself, leaves no trace beside the law."""
    return effect.replaces_law or type(effect).seen is not Effect.seen
