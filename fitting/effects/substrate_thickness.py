"""The substrate is thinner or thicker than stated."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import BarePlateModes
from fitting.effects.number_off import NumberOffEffect
from fitting.effects.substrate_stiffness import Substrate
from fitting.specimen import PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.other_plates import changed_to


def with_substrate(specimen: PlateSpecimen, scale: float) -> PlateSpecimen:
    """The plate with so many times its substrate's thickness."""
    face = specimen.substrate
    return replace(specimen, substrate=replace(face, thickness_m=scale * face.thickness_m))


class SubstrateThicknessEffect(Effect):
    """The substrate's thickness times a factor: its stiffness, mass and distance."""

    name = "substrate_thickness"
    enters = "stiffness"
    source = "the paper's Eq. (15) to (18) with another H_b"
    parameters = (EffectParameter("scale", "1", 0.75, 1.35, 1.03, neutral=1.0, spread=0.03),)
    spans = (Substrate(),)
    chance = 0.015
    discriminating_test = "a micrometer at the bare plate's corners"

    def on(self, kind: str) -> Effect | None:
        return NumberOffEffect(self, "substrate_thickness") if kind == "beam" else super().on(kind)

    def bare_shift(self, bare: BarePlateModes, u: Array) -> Array:
        # h^3 bends, h moves.
        return np.full(len(bare.lowering_per_density), np.log(u[0]))

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return changed_to(plate, with_substrate(plate.specimen, float(u[0])))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the substrate is {100 * (u['scale'] - 1):+.3g} % off its stated thickness"
