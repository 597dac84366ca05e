"""How strained the core is at every point of a sweep, softened or not: what softening with strain goes by."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.plate_answer import core_strain
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


class Strains:
    """Of one sweep on a plate."""

    def __init__(self, problem: DiagnosisProblem, plate: EnrichedReducedPlate, reference: Reference) -> None:
        self._problem, self._plate, self._reference = problem, plate, reference
        self._known: dict[bytes, Array] = {}

    def under(self, law: CoreLaw, key: bytes, changes: Callable[[], Change]) -> Strain:
        """At every point, softened by a share, over the reference; `changes` of the plate go by `key`.

        Solved for when it is first asked for, and once: who looks for how far a core softens asks many times.
        """
        points = self._problem.points
        drive = points.acceleration_m_s2 if points.force_n is None else points.force_n
        table = cache(lambda: self._table(law, key, changes))

        def strain(softened: Array) -> Array:
            cubic = table()
            logs_here = ((cubic[0] * softened + cubic[1]) * softened + cubic[2]) * softened + cubic[3]
            assert self._reference.strain is not None
            return np.asarray(np.exp(logs_here) * drive / self._reference.strain)

        return strain

    def _table(self, law: CoreLaw, key: bytes, changes: Callable[[], Change]) -> Array:
        """Ln strain for a unit of what drives it as a cubic of the softening. Shape (4, points)."""
        key = law.values.tobytes() + key
        if key not in self._known:
            nodes = self._problem.dense
            G, changed = law.modulus(nodes.omega), changes()
            square = self._plate.matrix("strain.mean_square")
            logs = [
                np.log(core_strain(self._plate, nodes.omega, G * (1 - s), square, changed)) for s in _SOFTENED
            ]
            table = np.linalg.solve(np.vander(_SOFTENED), np.array(logs) @ nodes.plain.T).astype(float)
            if len(self._known) > _KEPT:
                self._known.clear()
            self._known[key] = table
            if self._reference.strain is None:
                unit = PUBLISHED_G_M_S2 if self._problem.points.drive == "base" else 1.0
                self._reference.strain = float(np.exp(table[-1]).max()) * unit
        return self._known[key]
