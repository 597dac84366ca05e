"""A layer is heavier or lighter than stated: another metal's density, or mass that nobody counted.

Nearly all of a plate's motion is across it, so it is the mass per area that counts: whose density is off is
told by the hammer test of the bare plate alone, and by where a patch lies.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import BarePlateModes, Points
from fitting.effects.number_off import NumberOffEffect
from fitting.plate.parts import coefficients
from fitting.specimen import PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.other_plates import changed_to

SUBSTRATE, CONSTRAINING = 0.0, 1.0
"""Whose density it is."""


def with_density(specimen: PlateSpecimen, scale: float, layer: float) -> PlateSpecimen:
    """The plate with so many times the density of one of its faces."""
    name = "constraining" if layer == CONSTRAINING else "substrate"
    face = getattr(specimen, name)
    return replace(specimen, **{name: replace(face, density_kg_m3=scale * face.density_kg_m3)})


class LayerDensityEffect(Effect):
    """The density of the substrate (`layer` 0) or of the constraining layer (1) times a factor.

    It needs no motions of its own: a plate s times as heavy moves at a frequency as the stated one of a
    softer core does at sqrt(s) times that.
    """

    name = "layer_density"
    enters = "mass"
    source = "the paper's Eq. (15) to (18) with another density"
    parameters = (
        EffectParameter("scale", "1", 0.25, 4.0, 1.03, neutral=1.0, spread=0.05),
        EffectParameter("layer", "1", SUBSTRATE, CONSTRAINING, SUBSTRATE, neutral=None, fixed=True),
    )
    chance = 0.02
    discriminating_test = "the treated plate on a balance, its sides by caliper"

    def on(self, kind: str) -> Effect | None:
        return NumberOffEffect(self, "substrate_density") if kind == "beam" else super().on(kind)

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if plate.layers.any() else "the plate at hand does not know its layers"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([self.parameters[0].typical, layer]) for layer in (SUBSTRATE, CONSTRAINING)]

    def bare_shift(self, bare: BarePlateModes, u: Array) -> Array:
        felt = -0.5 * np.log(u[0]) if u[1] == SUBSTRATE else 0.0
        return np.full(len(bare.lowering_per_density), felt)

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        stated = plate.specimen
        other = with_density(stated, float(u[0]), float(u[1]))
        heavier = coefficients(other, stated).M[0] / coefficients(stated, stated).M[0]
        # C_1 = M Phi diag(2 zeta omega) Phi^T M of the same ratios; of a plate not treated all over nearly.
        return replace(changed_to(plate, other), damping=float(np.sqrt(heavier)))

    def story(self, u: Mapping[str, float]) -> str:
        layer = "constraining layer" if u.get("layer") == CONSTRAINING else "substrate"
        off = 100 * (u["scale"] - 1)
        return f"the {layer} is {off:+.3g} % off its stated density, or as much mass is off elsewhere"
