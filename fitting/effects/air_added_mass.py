"""The air moves with the plate: its inertia, left out of a plate in vacuum."""

from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.dynamics.air import StillAir, still_air
from fitting.effects.base import PLATE_AND_BEAM, Effect, EffectParameter
from fitting.effects.given import BarePlateModes, Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.span import Span


class Air(Span):
    """Motions with air's mass, for the density of one kilogram a cubic metre."""

    name = "air"

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return {"M": _air(full).L}

    def vectors(self, full: FullPlate) -> Mapping[str, Array]:
        air = _air(full)
        return {"load": -air.L @ air.heave}

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        L = _air(full).L
        return at.omega**2 * (L @ (L.T @ at.both))


def _air(full: FullPlate) -> StillAir:
    return full.once("air", lambda: still_air(full.loose))


class AirAddedMassEffect(Effect):
    """rho times the inertia of still incompressible air on both faces."""

    name = "air_added_mass"
    enters = "mass"
    structures = PLATE_AND_BEAM
    source = "potential flow about an unbaffled plate, `fitting.dynamics.air`"
    parameters = (
        EffectParameter("density", "kg/m^3", 0.0, 3.0, 1.2, spread=1.2),
        EffectParameter("bare_plate_too", "1", 0.0, 1.0, 0.0, neutral=None, fixed=True),
    )
    spans = (Air(),)
    unexplained_share = 0.003
    chance = 0.05
    discriminating_test = "the bare plate's natural frequencies (hammer test); a run in vacuum"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        # The bare plate feels the air too, unless its stated modulus was itself found by vibration in air.
        return [np.array([self.parameters[0].typical, felt]) for felt in (0.0, 1.0)]

    def bare_shift(self, bare: BarePlateModes, u: Array) -> Array:
        return np.asarray(-0.5 * np.log1p(2 * u[0] * u[1] * bare.lowering_per_density))

    def bare_forms(self, u: Array) -> list[Array]:
        return [np.array([u[0], felt]) for felt in (0.0, 1.0)]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return Change(M=u[0] * plate.matrix("air.M"), load=u[0] * plate.vector("air.load"))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the specimen carries air of {u['density']:.2g} kg/m^3 along"
