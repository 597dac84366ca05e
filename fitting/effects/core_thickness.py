"""The core is thinner or thicker than stated."""

from collections.abc import Mapping
from dataclasses import replace

from fitting.arrays import Array, Complex
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.number_off import NumberOffEffect
from fitting.specimen import PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.other_plates import changed_to, forces
from fitting.widened.span import Span

_SCALES = (0.85, 1.15)
"""Of the thickness: twice the spread of the prior, so that the basis follows any likely one."""


class Thickness(Span):
    """Motions with another core thickness."""

    name = "thickness"

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        return forces(full, at, [with_core(full.specimen, scale) for scale in _SCALES])


def with_core(specimen: PlateSpecimen, scale: float) -> PlateSpecimen:
    """The plate with so many times its core's thickness."""
    assert specimen.core is not None
    return replace(specimen, core=replace(specimen.core, thickness_m=scale * specimen.core.thickness_m))


class CoreThicknessEffect(Effect):
    """The core's thickness times a factor: its shear stiffness, mass and the faces' distance."""

    name = "core_thickness"
    enters = "stiffness"
    source = "the paper's Eq. (15) to (18) with another H_v"
    parameters = (EffectParameter("scale", "1", 0.5, 2.0, 1.05, neutral=1.0, spread=0.08),)
    spans = (Thickness(),)
    chance = 0.04
    discriminating_test = "a gauge; a second specimen of another thickness"

    def on(self, kind: str) -> Effect | None:
        return NumberOffEffect(self, "core_thickness") if kind == "beam" else super().on(kind)

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return changed_to(plate, with_core(plate.specimen, float(u[0])))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the core is {100 * (u['scale'] - 1):+.3g} % off its stated thickness"
