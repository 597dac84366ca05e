"""The yielding root takes energy too: its springs have a loss factor."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import CLAMP, PLATE_AND_BEAM, Effect, EffectParameter
from fitting.effects.clamp_compliance import STARTS_N_M3, BesideCompliance, ClampComplianceEffect, springs
from fitting.effects.given import Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate


class ClampFrictionEffect(BesideCompliance, Effect):
    """Springs at the root, k (1 + i loss)."""

    name = "clamp_friction"
    enters = "stiffness"
    structures = PLATE_AND_BEAM
    source = "hysteretic joint damping, Beards, Structural Vibration (1996), ch. 4"
    needs = CLAMP
    parameters = (
        *ClampComplianceEffect.parameters,
        EffectParameter("loss_factor", "1", 0.0, 1.0, 0.1, spread=0.3, mounting=0.1),
    )
    spans = ClampComplianceEffect.spans
    chance = 0.03
    discriminating_test = (
        "the hammer test repeated with the clamp tightened: its losses change, the core's do not"
    )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return ClampComplianceEffect().objection(points, plate)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([k, self.parameters[1].typical]) for k in STARTS_N_M3]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(K=(1 + 1j * u[1]) * springs(plate, u))

    def story(self, u: Mapping[str, float]) -> str:
        loss, k = u["loss_factor"], u["k"]
        return f"the clamp is elastic and rubs (loss factor {loss:.2g} in springs of {k:.2g} N/m^3)"
