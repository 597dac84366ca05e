"""The base turns about the plate's axis while it lifts: roll in fixed proportion to its acceleration."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import BASE, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.plate.element import THETA_X, V_C, W
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.span import UnitSpan

_MOST_RAD_M = 10.0
"""The edges of a plate 200 mm wide move as its base does: no rig is like that. A bound on the search."""
_ON_AXIS_M = 1e-4
"""A pickup so near to the axis hardly sees a roll."""


class Roll(UnitSpan):
    """Responses to a base that turns about x."""

    name = "roll"
    odd = True
    columns = 16

    def vectors(self, full: FullPlate) -> Mapping[str, Array]:
        return {"load": -(full.loose.M @ rolling(full))}

    def forces(self, full: FullPlate, at: Snapshot) -> Array:
        return -(full.loose.M @ rolling(full))[:, None]


def rolling(full: FullPlate) -> Array:
    """Rigid turn about the plate's axis, w = y - width / 2; the layers move along. Shape (n,)."""
    s = full.specimen
    r = np.zeros((full.loose.mesh.nodes, full.loose.mesh.dofs))
    r[:, W] = full.loose.mesh.node_positions()[:, 1] - s.width_m / 2
    r[:, THETA_X] = 1.0
    r[:, V_C] = -s.apart_m
    return np.asarray(r.ravel()[full.loose.free])


class BaseRollEffect(Effect):
    """Positive roll lifts the far edge, y = width, with the base."""

    name = "base_roll"
    enters = "load"
    source = "rigid turn of the base about x, inertia load -M r_r"
    needs = BASE
    parameters = (EffectParameter("roll", "rad/m", -_MOST_RAD_M, _MOST_RAD_M, 0.05, spread=0.1),)
    spans = (Roll(),)
    chance = 0.015
    discriminating_test = (
        "two accelerometers on the base, side by side; two spots at the same x on either side of the axis"
    )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        if abs(plate.pickup[1] - plate.width_m / 2) < _ON_AXIS_M:
            return "a pickup on the axis does not see the base roll"
        return None

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        # The pickup is turned along with the base.
        lever = plate.pickup[1] - plate.width_m / 2
        return Change(load=u[0] * plate.vector("roll.load"), travel=u[0] * lever)

    def story(self, u: Mapping[str, float]) -> str:
        return f"the base rolls with its acceleration ({u['roll']:+.2g} rad/m)"
