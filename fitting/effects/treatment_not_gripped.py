"""The clamp holds the substrate alone: core and constraining layer end free at it.

A free end of the constraining layer carries no tension: the plate is softer there, and its core shears
otherwise. The springs that hold it in its plane say how free it is.
"""

from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array
from fitting.effects.base import CLAMP, CONSTRAINED, WHOLE, Effect, EffectParameter
from fitting.effects.change import Change
from fitting.effects.clamp_span import ClampSpan, on_a_rim
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.effects.full_plate import FullPlate
from fitting.effects.given import Points
from fitting.effects.released_rim import clamped_edges, on_edge
from fitting.effects.released_root import along_root, on_root
from fitting.effects.span import Span
from fitting.element import DOFS, U_C, V_C

_SPANNED = (1e6, 1e8, 4e8, 3e9)
"""N/m^2, from nearly free to nearly gripped."""


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

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if "treatment" in plate.group else "the plate has no clamp"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([k]) for k in (1e7, 3e8)]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(K=u[0] * plate.matrix("treatment.hold"))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the clamp hardly holds the constraining layer ({u['k']:.2g} N/m^2 in its plane)"


class TreatmentOfBeamEffect(TreatmentNotGrippedEffect):
    """Of a sandwich beam: on one side, or alike on both."""

    needs = CLAMP | CONSTRAINED
