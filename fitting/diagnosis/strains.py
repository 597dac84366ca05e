"""How strained the core is at every point of a sweep, softened or not: what softening with strain goes by."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TypeVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.plate_answer import Asked, StrainedCore
from fitting.diagnosis.plate_poles import PLAIN
from fitting.diagnosis.problem import DiagnosisProblem
from fitting.effects.base import Strain
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws import CoreLaw

_SOFTENED = np.array([-0.3, 0.0, 0.25, 0.5])
"""Shares by which the core softens where its strain is computed: a cubic through them serves all between.

Where little damps the plate its strain rises near a pole as one over the distance, and the pole moves as the
core softens: times the distance it is smooth, in the frequency and in the share.
"""
_KEPT = 8
"""Tables of the core's strain for unknowns just asked for; more are begun anew. A choice."""


@dataclass
class Reference:
    """The strain that softening is told for: the largest at 1 g, or at 1 N of a force, when first asked for.

    Sweeps of one plate have one: of the first of them.
    """

    strain: float | None = None


@dataclass(frozen=True)
class _Table:
    """Strain for a unit of what drives it, and the cores that it was read of, one a share."""

    cubic: Array
    """Of ln strain times the distance from the poles, in the softening. Shape (4, points)."""
    poles: Complex
    """Of their squares, in the softening. Shape (4, poles)."""
    away: Array
    """From the poles, at the nodes of every share. Shape (4 nodes,)."""
    core: StrainedCore


Changes = Callable[[], Change]
A = TypeVar("A", Array, Complex)


class Strains:
    """Of one sweep on a plate."""

    def __init__(self, problem: DiagnosisProblem, plate: EnrichedReducedPlate, reference: Reference) -> None:
        self._problem, self._plate, self._reference = problem, plate, reference
        self._known: dict[bytes, _Table] = {}

    def under(self, law: CoreLaw, key: bytes, changes: Changes) -> Strain:
        """At every point, softened by a share, over the reference; `changes` of the plate go by `key`.

        Solved for when it is first asked for, and once: who looks for how far a core softens asks many times.
        """
        return self._of(cache(lambda: self._table(law, key, changes)))

    def along(
        self, law: CoreLaw, key: bytes, changes: Changes, nearby: tuple[Change, Change, float], step: float
    ) -> Strain:
        """The same a `step` of an unknown further, to first order: `nearby` as `StrainedCore.by` takes it."""

        @cache
        def slope() -> Array:
            table = self._table(law, key, changes)
            # As a pole moves this changes as one over the distance, and as its conjugate's.
            return self._cubic(table.core.by(nearby) * table.away**2)

        return self._of(cache(lambda: self._table(law, key, changes)), lambda: step * slope())

    def _of(self, table: Callable[[], _Table], further: Callable[[], Array] | None = None) -> Strain:
        """`further`: what ln strain changes by, times the square of the distance. Shape (4, points)."""
        points = self._problem.points
        drive = points.acceleration_m_s2 if points.force_n is None else points.force_n

        def strain(softened: Array) -> Array:
            known = table()
            away = self._away(known.poles, softened)
            logs_here = _at(known.cubic, softened)
            if further is not None:
                logs_here = logs_here + _at(further(), softened) / away**2
            assert self._reference.strain is not None
            return np.asarray(np.exp(logs_here) / away * drive / self._reference.strain)

        return strain

    def _away(self, poles: Complex, softened: Array) -> Array:
        """From the poles, each point's core softened by its share. Shape (points,)."""
        return self._problem.dense.away(lambda mine, at: _at(poles[:, mine, None], softened[at]))

    def _table(self, law: CoreLaw, key: bytes, changes: Changes) -> _Table:
        key = law.values.tobytes() + key
        if key not in self._known:
            dense = self._problem.dense
            G, change = law.modulus(dense.omega), changes()
            each = np.concatenate([G * (1 - s) for s in _SOFTENED])
            core = StrainedCore(self._plate, np.tile(dense.omega, len(_SOFTENED)), each, change)
            squares = np.array([self._poles(G * (1 - s), change) for s in _SOFTENED]) ** 2
            away = np.concatenate([self._away_at_nodes(p) for p in squares])
            poles = np.linalg.solve(np.vander(_SOFTENED), squares)
            table = _Table(self._cubic(np.log(core.strain * away)), poles, away, core)
            if len(self._known) > _KEPT:
                self._known.clear()
            self._known[key] = table
            if self._reference.strain is None:
                unit = PUBLISHED_G_M_S2 if self._problem.points.drive == "base" else 1.0
                none = np.zeros(len(dense.points))
                largest = np.exp(table.cubic[-1]) / self._away(table.poles, none)
                self._reference.strain = float(largest.max()) * unit
        return self._known[key]

    def _away_at_nodes(self, squares: Complex) -> Array:
        """The same at the nodes, from poles that are the same for all. Shapes (poles,) to (nodes,)."""
        return self._problem.dense.away(lambda mine, at: squares[mine, None], at_nodes=True)

    def _poles(self, G: Complex, change: Change) -> Complex:
        """That the nodes were made for, under a modulus given there, of the plate as something changes it."""
        dense, poles = self._problem.dense, self._problem.fine.poles
        if poles is None or not len(dense.poles):
            return dense.poles
        known = poles.known(dense, G).on(self._plate.group == PLAIN)
        asked = Asked(self._plate, dense.omega, G, change, known, with_pitch=False)
        return known.followed(asked.matrices)[0]

    def _cubic(self, values: Array) -> Array:
        """Through values at the nodes, one share after the other. Shapes (4 nodes,) to (4, points)."""
        each = values.reshape(len(_SOFTENED), -1) @ self._problem.dense.plain.T
        return np.linalg.solve(np.vander(_SOFTENED), each).astype(float)


def _at(cubic: A, x: Array) -> A:
    """Cubics with coefficients of shape (4, ...) at some places; shape (...) joined with that of `x`."""
    return ((cubic[0] * x + cubic[1]) * x + cubic[2]) * x + cubic[3]
