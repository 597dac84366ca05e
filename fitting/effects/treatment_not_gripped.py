"""The clamp holds the substrate alone: core and constraining layer end free at it.

A free end of the constraining layer carries no tension: the plate is softer there, and its core shears
otherwise. The springs that hold it in its plane say how free it is.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array
from fitting.effects.base import CLAMP, CONSTRAINED, WHOLE, Effect, EffectParameter
from fitting.effects.clamp_compliance import YieldingRoot
from fitting.effects.given import Points
from fitting.effects.number_off import changed_by_numbers
from fitting.plate.element import DOFS, U_C, V_C
from fitting.specimen import StatedSpecimen
from fitting.widened.change import Change
from fitting.widened.clamp_span import ClampSpan, on_a_rim
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate
from fitting.widened.released_rim import clamped_edges, on_edge
from fitting.widened.released_root import along_root, on_root
from fitting.widened.span import Span

_SPANNED = (1e6, 1e8, 4e8, 3e9)
"""N/m^2, from nearly free to nearly gripped."""
_STARTS_N_M2, _STARTS_M = (1e7, 3e8), (1e-3, 5e-3)
"""To begin with: springs that hold it, and what it ends short by. A choice."""
_LEAST_M, _MOST = 1e-4, 0.1
"""What a treatment may end short of a clamp by, in m and of the free length. Choices."""


class FreeTreatment(ClampSpan):
    """Motions with the constraining layer let go at the clamps, w and the substrate held."""

    name = "treatment"
    released = released_along_x = (U_C, V_C)
    columns = 12

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return {"hold": hold(full)}

    def springs(self, full: FullPlate) -> list[sp.csc_array]:
        S = full.once("hold of the treatment", lambda: hold(full))
        return [k * S for k in _SPANNED]


def hold(full: FullPlate) -> sp.csc_array:
    """Unit springs per width on the constraining layer's clamped edges, along x and y. Shape (n, n)."""
    local = np.zeros((DOFS, DOFS))
    local[U_C, U_C] = local[V_C, V_C] = 1.0
    if on_a_rim(full):
        return sp.csc_array(sum(on_edge(full, edge, local) for edge in clamped_edges(full)))
    return on_root(full, along_root(full), local)


class TreatmentNotGrippedEffect(Effect):
    """Springs k per width hold the constraining layer in its plane at the clamp; none would leave it free."""

    name = "treatment_not_gripped"
    enters = "stiffness"
    source = "free end of a constrained layer, e.g. Plunkett and Lee, J. Acoust. Soc. Am. 48 (1970)"
    needs = CLAMP | WHOLE
    parameters = (
        EffectParameter(
            "k", "N/m^2", 1e6, 1e12, 1e8, logarithmic=True, neutral=float("inf"), complete=True, mounting=1.0
        ),
    )
    spans: tuple[Span, ...] = (FreeTreatment(),)
    discriminating_test = (
        "a look at the clamp: whether the treatment reaches between the jaws; a strip of it glued down"
    )

    def on(self, kind: str) -> Effect | None:
        return TreatmentOfBeamEffect() if kind == "beam" else super().on(kind)

    def form_on(self, specimens: Sequence[StatedSpecimen]) -> Effect | None:
        form = super().form_on(specimens)
        if not isinstance(form, TreatmentOfBeamEffect):
            return form
        clamps = {2 if "two clamps" in s.offers else 1 for s in specimens}
        return TreatmentOfBeamEffect(clamps.pop() if len(clamps) == 1 else None)

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if "treatment" in plate.group else "the plate has no clamp"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([k]) for k in _STARTS_N_M2]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(K=u[0] * plate.matrix("treatment.hold"))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the clamp hardly holds the constraining layer ({u['k']:.2g} N/m^2 in its plane)"


class LetGo(Span):
    """What a beam's treatment does at its clamps, and all that follows."""

    name = "treatment"
    overlaps = True


class TreatmentOfBeamEffect(TreatmentNotGrippedEffect):
    """Of a sandwich beam: on one side, or alike on both. It may end short of its clamps."""

    needs = CLAMP | CONSTRAINED
    spans: tuple[Span, ...] = (LetGo(),)

    def __init__(self, clamps: int | None = 1) -> None:
        """`clamps` of the beam; None for beams of which one has more of them than another."""
        self.clamps = clamps

    def variants(self) -> tuple[Effect, ...]:
        return (self,) if self.clamps is None else (self, TreatmentEndsShortEffect(self.clamps))


class TreatmentEndsShortEffect(TreatmentOfBeamEffect):
    """A bare strip of the substrate holds the sandwich at every clamp (`structures.beam_strip`).

    The sandwich is shorter by it, its constraining layer free: it neither stretches nor bends at its end.
    """

    source = "consistent matrices of an Euler-Bernoulli strip, e.g. Cook et al., Concepts of Finite Elements"
    parameters = (EffectParameter("gap", "m", 0.0, 0.03, 3e-3, spread=5e-3),)
    spans = (YieldingRoot(), LetGo())

    def variants(self) -> tuple[Effect, ...]:
        return (self,)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([g]) for g in _STARTS_M]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = super().limits(plate)
        return np.maximum(lower, _LEAST_M), np.minimum(upper, _MOST * plate.length_m)

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        assert self.clamps is not None
        g = float(u[0])
        shorter = 1 - self.clamps * g / plate.length_m

        def of(key: str) -> Array:
            return plate.matrix(f"root.strip_{key}")

        # Turns are slopes of the beam as long as it is stated.
        spring = of("spring_3") / g**3 + of("spring_2") / g**2 / shorter + of("spring_1") / g / shorter**2
        mass = g * of("mass_1") + g**2 * of("mass_2") / shorter + g**3 * of("mass_3") / shorter**2
        lift = g * plate.vector("root.strip_lift_1") + g**2 * plate.vector("root.strip_lift_2") / shorter
        x, y = plate.pickup
        observe = plate.row((x - g) / shorter, y) - plate.pickup_row
        own = changed_by_numbers(plate, {"span": -self.clamps * g})
        return own.and_then(Change(K=spring + of("slide") / g, M=mass, load=lift, observe=observe))

    def story(self, u: Mapping[str, float]) -> str:
        return f"core and constraining layer end {1e3 * u['gap']:.1f} mm short of the clamp"
