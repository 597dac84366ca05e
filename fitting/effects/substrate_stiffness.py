"""The substrate is stiffer or softer than its data sheet."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import BarePlateModes
from fitting.effects.number_off import NumberOffEffect
from fitting.numerics.linear import times
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.other_plates import changed_to
from fitting.widened.span import Span

_TYPICAL = 0.1
"""Of the stiffness: twice the spread of the prior, so that the basis follows any likely one."""


class Substrate(Span):
    """Motions with a stiffer substrate."""

    name = "substrate"

    def forces(self, full: FullPlate, at: Snapshot) -> Array | Complex:
        return _TYPICAL * times(full.loose.K_substrate, at.both)


class SubstrateStiffnessEffect(Effect):
    """Young's modulus of the substrate times a factor."""

    name = "substrate_stiffness"
    enters = "stiffness"
    source = "the paper's Eq. (15a)"
    parameters = (EffectParameter("scale", "1", 0.5, 2.0, 1.03, neutral=1.0, spread=0.05),)
    spans = (Substrate(),)
    chance = 0.03
    discriminating_test = "the bare plate's natural frequencies (hammer test)"

    def on(self, kind: str) -> Effect | None:
        return NumberOffEffect(self, "substrate_young") if kind == "beam" else super().on(kind)

    def bare_shift(self, bare: BarePlateModes, u: Array) -> Array:
        return np.full(len(bare.lowering_per_density), 0.5 * np.log(u[0]))

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        s = plate.specimen
        young = u[0] * s.substrate.young_pa
        return changed_to(plate, replace(s, substrate=replace(s.substrate, young_pa=young)))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the substrate is {100 * (u['scale'] - 1):+.3g} % off its stated stiffness"
