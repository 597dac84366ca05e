"""How strained the core is at every point of a sweep, softened or not: what softening with strain goes by."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.plate_answer import StrainedCore
from fitting.diagnosis.problem import DiagnosisProblem
from fitting.effects.base import Strain
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws import CoreLaw

_SOFTENED = np.array([-0.3, 0.0, 0.25, 0.5])
"""Shares by which the core softens where its strain is computed: a cubic through them serves all between."""
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
    """Ln strain for a unit of what drives it, and the cores that it was read of, one a share."""

    cubic: Array
    """In the softening. Shape (4, points)."""
    core: StrainedCore


Changes = Callable[[], Change]


class Strains:
    """Of one sweep on a plate."""

    def __init__(self, problem: DiagnosisProblem, plate: EnrichedReducedPlate, reference: Reference) -> None:
        self._problem, self._plate, self._reference = problem, plate, reference
        self._known: dict[bytes, _Table] = {}

    def under(self, law: CoreLaw, key: bytes, changes: Changes) -> Strain:
        """At every point, softened by a share, over the reference; `changes` of the plate go by `key`.

        Solved for when it is first asked for, and once: who looks for how far a core softens asks many times.
        """
        return self._of(cache(lambda: self._table(law, key, changes).cubic))

    def along(
        self, law: CoreLaw, key: bytes, changes: Changes, nearby: tuple[Change, Change, float], step: float
    ) -> Strain:
        """The same a `step` of an unknown further, to first order: `nearby` as `StrainedCore.by` takes it."""

        def moved() -> Array:
            table = self._table(law, key, changes)
            return table.cubic + step * self._cubic(table.core.by(nearby))

        return self._of(cache(moved))

    def _of(self, table: Callable[[], Array]) -> Strain:
        points = self._problem.points
        drive = points.acceleration_m_s2 if points.force_n is None else points.force_n

        def strain(softened: Array) -> Array:
            cubic = table()
            logs_here = ((cubic[0] * softened + cubic[1]) * softened + cubic[2]) * softened + cubic[3]
            assert self._reference.strain is not None
            return np.asarray(np.exp(logs_here) * drive / self._reference.strain)

        return strain

    def _table(self, law: CoreLaw, key: bytes, changes: Changes) -> _Table:
        key = law.values.tobytes() + key
        if key not in self._known:
            omega = self._problem.dense.omega
            G = np.concatenate([law.modulus(omega) * (1 - s) for s in _SOFTENED])
            core = StrainedCore(self._plate, np.tile(omega, len(_SOFTENED)), G, changes())
            table = _Table(self._cubic(np.log(core.strain)), core)
            if len(self._known) > _KEPT:
                self._known.clear()
            self._known[key] = table
            if self._reference.strain is None:
                unit = PUBLISHED_G_M_S2 if self._problem.points.drive == "base" else 1.0
                self._reference.strain = float(np.exp(table.cubic[-1]).max()) * unit
        return self._known[key]

    def _cubic(self, values: Array) -> Array:
        """Through values at the nodes, one share after the other. Shapes (4 nodes,) to (4, points)."""
        each = values.reshape(len(_SOFTENED), -1) @ self._problem.dense.plain.T
        return np.linalg.solve(np.vander(_SOFTENED), each).astype(float)
