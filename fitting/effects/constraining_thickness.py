"""The constraining layer is thinner or thicker than stated."""

from collections.abc import Mapping
from dataclasses import replace

from fitting.arrays import Array, Complex
from fitting.effects.base import CONSTRAINED, Effect, EffectParameter
from fitting.effects.number_off import NumberOffEffect
from fitting.specimen import PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.other_plates import changed_to, forces
from fitting.widened.span import Span

_SCALES = (0.85, 1.15)
"""Of the thickness: three times the spread of the prior, so that the basis follows any likely one."""


class ConstrainingLayer(Span):
    """Motions with another constraining layer."""

    name = "layer"
    columns = 12

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        return forces(full, at, [with_layer(full.specimen, scale) for scale in _SCALES])


def with_layer(specimen: PlateSpecimen, scale: float) -> PlateSpecimen:
    """The plate with so many times its constraining layer's thickness."""
    layer = specimen.constraining
    assert layer is not None
    return replace(specimen, constraining=replace(layer, thickness_m=scale * layer.thickness_m))


class ConstrainingThicknessEffect(Effect):
    """The constraining layer's thickness times a factor: its stiffness, mass and distance."""

    name = "constraining_thickness"
    enters = "stiffness"
    source = "the paper's Eq. (15) to (18) with another H_c"
    parameters = (EffectParameter("scale", "1", 0.5, 2.0, 1.03, neutral=1.0, spread=0.05),)
    spans = (ConstrainingLayer(),)
    chance = 0.015
    discriminating_test = "a micrometer at the layer's edge; the plate weighed before and after treatment"

    def on(self, kind: str) -> Effect | None:
        return (
            NumberOffEffect(self, "constraining_thickness", CONSTRAINED)
            if kind == "beam"
            else super().on(kind)
        )

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return changed_to(plate, with_layer(plate.specimen, float(u[0])))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the constraining layer is {100 * (u['scale'] - 1):+.3g} % off its stated thickness"
