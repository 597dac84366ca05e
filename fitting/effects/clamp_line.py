"""The clamp's edge bites elsewhere than stated: the free length is another."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import CLAMP, ROOT, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.effects.number_off import changed_by_numbers
from fitting.specimen import PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.other_plates import changed_to, forces
from fitting.widened.span import UNIT_RESPONSE, Span

_MOUNTING_M = 3e-4
"""A jaw bites at its edge, however hard: put to the same mark a plate comes back to some tenths of a mm."""
_SCALES = (0.98, 1.02)
"""Over the stated length."""


class Length(Span):
    """Motions of a longer or a shorter plate, stretched to the stated one, and of its pickup."""

    name = "length"
    columns = 16

    def forces(self, full: FullPlate, at: Snapshot) -> Array | Complex:
        if "root" not in full.specimen.offers:
            return super().forces(full, at)
        length = full.specimen.length_m
        places = [
            (place, y)
            for x, y in full.specimen.pickups_m
            for scale in _SCALES
            for place in (x / scale, (x + (scale - 1) * length) / scale)
        ]
        rows = np.column_stack([full.loose.observe(float(np.clip(x, 0.0, length)), y) for x, y in places])
        others = [with_length(full.specimen, scale * length) for scale in _SCALES]
        return np.hstack([forces(full, at, others), rows])

    def responses(self, full: FullPlate, at: Snapshot, answers: Complex) -> Complex:
        few = at.both.shape[1] * len(_SCALES)
        rows = full.unit(answers[:, few:])
        return np.hstack([answers[:, :few], UNIT_RESPONSE * rows])


def with_length(specimen: PlateSpecimen, length_m: float) -> PlateSpecimen:
    """The plate so long, of as many elements; patches are stretched with it."""
    longer = length_m / specimen.length_m
    patches = tuple(
        replace(p, from_x_m=longer * p.from_x_m, to_x_m=longer * p.to_x_m) for p in specimen.patches
    )
    return replace(specimen, length_m=length_m, elements=specimen.mesh, patches=patches)


class ClampLineEffect(Effect):
    """The free length is the stated one and `dlength`.

    The pickup stays where it is stated from the true line, or was measured from the visible edge too
    (`pickup_too`).
    """

    name = "clamp_line"
    enters = "stiffness"
    source = "the paper's Eq. (15) to (18) on a mesh stretched along x; the viscous damping kept"
    needs = ROOT
    parameters: tuple[EffectParameter, ...] = (
        EffectParameter("dlength", "m", -8e-3, 8e-3, 1e-3, spread=2e-3, mounting=_MOUNTING_M),
        EffectParameter("pickup_too", "1", 0.0, 1.0, 0.0, neutral=None, fixed=True),
    )
    spans: tuple[Span, ...] = (Length(),)
    chance = 0.03
    discriminating_test = (
        "a feeler gauge or blueing paper in the clamp; the plate clamped anew, further in by a known step"
    )

    def on(self, kind: str) -> Effect | None:
        return ClampLineOfBeamEffect() if kind == "beam" else super().on(kind)

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if "length" in plate.group else "the plate has no clamp"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([self.parameters[0].typical, too]) for too in (1.0, 0.0)]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        length = plate.length_m + float(u[0])
        x, y = plate.pickup
        found = changed_to(plate, with_length(plate.specimen, length))
        place = (x + float(u[0] * u[1])) * plate.length_m / length
        return replace(found, observe=plate.row(place, y) - plate.pickup_row)

    def longer_m(self, u: Array) -> float:
        """As `Effect.longer_m`, of `u` of shape (parameters,)."""
        return float(u[0])

    def story(self, u: Mapping[str, float]) -> str:
        return f"the plate is free over {_beside_stated(u)}"


def _beside_stated(u: Mapping[str, float]) -> str:
    mm = 1e3 * u["dlength"]
    return f"{abs(mm):.1f} mm {'more' if mm > 0 else 'less'} than its stated length"


class ClampLineOfBeamEffect(ClampLineEffect):
    """Of a beam, whose matrices know its free length; of one driven in its centre, both halves alike."""

    spans = ()
    needs = CLAMP

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        length = plate.length_m + float(u[0])
        x, y = plate.pickup
        place = (x + float(u[0] * u[1])) * plate.length_m / length
        observe = plate.row(place, y) - plate.pickup_row
        return replace(changed_by_numbers(plate, {"span": float(u[0])}), observe=observe)

    def story(self, u: Mapping[str, float]) -> str:
        return f"the beam is free over {_beside_stated(u)}"
