"""The constraining layer is stiffer or softer than its data sheet."""

from collections.abc import Mapping
from dataclasses import replace

from fitting.arrays import Array, Complex
from fitting.effects.base import CONSTRAINED, Effect, EffectParameter
from fitting.effects.number_off import NumberOffEffect
from fitting.numerics.linear import times
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.other_plates import changed_to
from fitting.widened.span import Span

_TYPICAL = 0.1
"""Of the stiffness: twice the spread of the prior, so that the basis follows any likely one."""


class Constraining(Span):
    """Motions with a stiffer constraining layer."""

    name = "constraining"
    columns = 8

    def forces(self, full: FullPlate, at: Snapshot) -> Array | Complex:
        return _TYPICAL * times(full.loose.K_constraining, at.both)


class ConstrainingStiffnessEffect(Effect):
    """Young's modulus of the constraining layer times a factor."""

    name = "constraining_stiffness"
    enters = "stiffness"
    source = "the paper's Eq. (15c)"
    parameters = (EffectParameter("scale", "1", 0.5, 2.0, 1.03, neutral=1.0, spread=0.05),)
    spans = (Constraining(),)
    chance = 0.015
    discriminating_test = (
        "a strip of the constraining layer in a tensile test, or its own bending frequencies"
    )

    def on(self, kind: str) -> Effect | None:
        return (
            NumberOffEffect(self, "constraining_young", CONSTRAINED) if kind == "beam" else super().on(kind)
        )

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        s = plate.specimen
        assert s.constraining is not None
        young = u[0] * s.constraining.young_pa
        return changed_to(plate, replace(s, constraining=replace(s.constraining, young_pa=young)))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the constraining layer is {100 * (u['scale'] - 1):+.3g} % off its stated stiffness"
