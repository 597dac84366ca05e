"""Two clamps pull a beam along, or press it, by more than their tolerance."""

from collections.abc import Mapping

from fitting.arrays import Array
from fitting.digits import two_digits
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.effects.number_off import moved


class AxialStressEffect(Effect):
    """A force along the beam: its work is half of it times the integral of w'^2."""

    name = "axial_stress"
    enters = "stiffness"
    source = "Timoshenko, Vibration Problems in Engineering (1937), a bar with an axial force"
    structures = frozenset({"beam"})
    needs = frozenset({"two clamps"})
    parameters = (EffectParameter("stress", "MPa", -50.0, 200.0, 3.0, spread=10.0, below=0.4, mounting=3.0),)
    chance = 0.05
    discriminating_test = (
        "the same beam with one of its clamps loosened and tightened again, or clamped at one end"
    )

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return moved(plate, {"axial": 1e6 * float(u[0])})

    def story(self, u: Mapping[str, float]) -> str:
        verb = "pulled" if u["stress"] > 0 else "pressed"
        size = two_digits(abs(u["stress"]))
        return f"the beam is {verb} along by its clamps, {size} MPa of stress in its faces"
