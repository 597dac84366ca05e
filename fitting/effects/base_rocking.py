"""The base turns while it lifts: pitch in fixed proportion to its acceleration."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array, Complex
from fitting.effects.base import BASE, PLATE_AND_BEAM, Effect, EffectParameter
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.span import UnitSpan


class Pitch(UnitSpan):
    """Responses to a turning base."""

    name = "pitch"

    def forces(self, full: FullPlate, at: Snapshot) -> Array:
        return -(full.loose.M @ full.pitching)[:, None]


class BaseRockingEffect(Effect):
    """Positive pitch lifts the tip with the base."""

    name = "base_rocking"
    enters = "load"
    structures = PLATE_AND_BEAM
    source = "rigid turn of the base about the root, inertia load -M r_p"
    needs = BASE
    parameters = (EffectParameter("pitch", "rad/m", -2.0, 2.0, 0.05, spread=0.1),)
    spans = (Pitch(),)
    chance = 0.03
    discriminating_test = "two accelerometers on the base, one behind the other"

    def pitch(self, omega: Array, u: Array) -> Complex:
        return np.full(len(omega), u[0] + 0j)

    def story(self, u: Mapping[str, float]) -> str:
        return f"the base pitches with its acceleration ({u['pitch']:+.2g} rad/m)"
