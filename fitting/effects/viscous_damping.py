"""The hammer test's damping ratios do not carry over to the treated plate."""

from collections.abc import Mapping

from fitting.arrays import Array
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate


class ViscousDampingEffect(Effect):
    """C_1 times a factor."""

    name = "viscous_damping"
    enters = "damping"
    source = "the paper's section 4: C_1 is taken over from the bare plate"
    parameters = (EffectParameter("scale", "1", 0.0, 8.0, 2.0, neutral=1.0, spread=1.0),)
    chance = 0.05
    discriminating_test = "the hammer test of the treated plate at two core temperatures"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None if len(plate.d) else "the specimen states no viscous damping"

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(damping=float(u[0]))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the remaining damping is {u['scale']:.2g} times the bare plate's"
