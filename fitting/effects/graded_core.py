"""The core's modulus changes along the plate: cured, aged or warmed more at one end."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.effects.base import WHOLE, Effect, EffectParameter
from fitting.effects.partial_debond import strips
from fitting.numerics.linear import times
from fitting.plate.element import core_shear
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.span import Span

_GRADE = 2.0
"""Of the motions spanned."""


class Grading(Span):
    """Motions with a graded core. Apart from the strips' own: these add up where a strip's do not."""

    columns = 10

    def __init__(self, along: str) -> None:
        self.along = along
        self.name = f"grading_{along}"
        self.odd = along == "y"

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return {"K_1": tilted(full, self.along)}

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        return self._of(full, at, at.both)

    def responses(self, full: FullPlate, at: Snapshot, answers: Complex) -> Complex:
        odd = self.odd or not full.only_even
        return np.hstack([answers, at.solve(self._of(full, at, answers), odd=odd)])

    def _of(self, full: FullPlate, at: Snapshot, X: Complex) -> Complex:
        return np.asarray(_GRADE * at.G * times(tilted(full, self.along), X))


def tilted(full: FullPlate, along: str) -> sp.csc_array:
    """Shear stiffness for G = 1 Pa times s - 1/2, s from 0 to 1 along x or y. Shape (n, n)."""

    def make() -> sp.csc_array:
        rows = strips(full, along)
        found = full.loose.scatter(_tilted_element(full, along) / len(rows))
        for k, A in enumerate(rows):
            found = found + ((k + 0.5) / len(rows) - 0.5) * A
        return sp.csc_array(found)

    return full.once(f"tilted along {along}", make)


def _tilted_element(full: FullPlate, along: str) -> Array:
    """An element's shear stiffness times s - 1/2, s from 0 to 1 within it. Shape (4 dofs, 4 dofs)."""
    s = full.specimen
    assert s.core is not None
    assert s.constraining is not None
    shape = full.loose.mesh.shape
    t, weight = np.polynomial.legendre.leggauss(4)
    found = np.zeros((4 * shape.dofs, 4 * shape.dofs))
    for tx, wx in zip(t, weight, strict=True):
        for ty, wy in zip(t, weight, strict=True):
            x, y = shape.a_m * (tx + 1) / 2, shape.b_m * (ty + 1) / 2
            N = np.array(core_shear(shape, s.core, s.substrate, s.constraining, x, y))
            dA = shape.a_m * shape.b_m / 4 * wx * wy
            found += (tx if along == "x" else ty) / 2 * s.core.thickness_m * dA * (N.T @ N)
    return found


class GradedCoreEffect(Effect):
    """G times 1 + grade (s - 1/2), s along the length or across the width from 0 to 1."""

    name = "graded_core"
    enters = "stiffness"
    needs = WHOLE
    source = "first order in the place; the core's shear alone"
    unexplained_share = 0.004
    chance = 0.015
    discriminating_test = (
        "strips of the core tested one by one; the sweep repeated after hours at one temperature"
    )

    whose: ClassVar[str] = "plate"
    """Core, for people."""

    def __init__(self, along: str = "x") -> None:
        self.along = along
        self.spans = (Grading(along),)
        self.parameters = (EffectParameter(f"grade_{along}", "1", -1.5, 1.5, 0.2, spread=0.3),)

    def on(self, kind: str) -> Effect | None:
        return GradedCoreOfBeamEffect() if kind == "beam" else super().on(kind)

    def variants(self) -> tuple[Effect, ...]:
        return (self, GradedCoreEffect("y"))

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(K_1=u[0] * plate.matrix(f"grading_{self.along}.K_1"))

    def story(self, u: Mapping[str, float]) -> str:
        grade = u[f"grade_{self.along}"]
        ends = ["root", "tip"] if self.along == "x" else ["near edge", "far edge"]
        softer, stiffer = ends if grade > 0 else reversed(ends)
        ratio = (2 + abs(grade)) / (2 - abs(grade))
        stiff = f"{ratio:.3g} times as large at the {self.whose}'s {stiffer}"
        return f"the core's modulus is {stiff} as at its {softer}"


class GradedCoreOfBeamEffect(GradedCoreEffect):
    """Along a beam alone, where a core may be uneven in its thickness too."""

    whose = "beam"

    def variants(self) -> tuple[Effect, ...]:
        return (self, UnevenCoreEffect("wedge"), UnevenCoreEffect("bow"))


class Uneven(Span):
    """What a beam's core does whose thickness is a line or a parabola."""

    def __init__(self, shape: str) -> None:
        self.name = f"uneven_{shape}"


class UnevenCoreEffect(GradedCoreOfBeamEffect):
    """Thickness times 1 + delta, s from 0 to 1 along a beam.

    delta = wedge (s - 1/2), or bow (4 s (1 - s) - 2/3): a core pressed thinner at its ends, or in its middle.
    """

    source = "the core's slip, 1/(1 + delta) to third order, its mass, and an outer face that is not straight"

    def __init__(self, shape: str) -> None:
        super().__init__()
        self.shape = shape
        self.spans = (Uneven(shape),)
        self.parameters = (EffectParameter(shape, "1", -0.6, 0.6, 0.1, spread=0.15),)

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        def of(key: str) -> Array:
            return plate.matrix(f"uneven_{self.shape}.{key}")

        slip = u[0] * of("K_1") + sum(u[0] ** n * of(f"inverse_{n}") for n in (1, 2, 3))
        tilted = u[0] * of("tilted_1") + u[0] ** 2 * of("tilted_2")
        load = u[0] * plate.vector(f"uneven_{self.shape}.load")
        return Change(K=tilted, K_1=slip, M=u[0] * of("M"), load=load)

    def story(self, u: Mapping[str, float]) -> str:
        by = u[self.shape]
        thicker = f"{100 * abs(by):.0f} % {'thicker' if by > 0 else 'thinner'}"
        if self.shape == "bow":
            return f"the core is {thicker} in the middle of the beam than at its ends"
        return f"the core is {thicker} at the beam's far end than at its near one"
