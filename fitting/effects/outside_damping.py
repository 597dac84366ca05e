"""Something beside the beam damps it: a film of air in a narrow gap, eddy currents under a magnet."""

from collections.abc import Mapping

from fitting.arrays import Array
from fitting.effects.air_added_mass import Air
from fitting.effects.base import Effect, EffectParameter
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate


class OutsideDampingEffect(Effect):
    """C = c times the integral of w w over a face, all along the beam, against what moves with the base.

    Of a plate the hammer test's ratios hold it, and `viscous_damping` their error.
    """

    name = "outside_damping"
    enters = "damping"
    source = "viscous damping alike over the length, Timoshenko, Vibration Problems in Engineering, section 5"
    structures = frozenset({"beam"})
    parameters = (EffectParameter("c", "N s/m^3", 0.0, 1e3, 5.0, spread=20.0),)
    spans = (Air(),)
    chance = 0.03
    discriminating_test = "nothing within some centimetres of the beam; another pickup without a magnet"

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(C=float(u[0]) * plate.matrix("air.film"))

    def story(self, u: Mapping[str, float]) -> str:
        return f"something outside damps the beam, {u['c']:.2g} N s/m per square metre of it"
