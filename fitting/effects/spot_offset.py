"""The laser's spot lies beside where it is thought to be."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array
from fitting.effects.along_a_beam import AlongABeam
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.span import Span, UnitSpan

_AROUND_M = ((8e-3, 0.0), (-8e-3, 0.0), (0.0, 8e-3), (0.0, -8e-3))
"""Pushes about the pickup: between them the answer at a shifted spot is nearly linear. A choice."""
_DIRECTIONS = np.arange(0, np.pi, np.pi / 6)
"""Of the spot from where it is thought to be, to begin with: over half a turn. A choice."""


class Spot(UnitSpan):
    """Responses to a push beside the pickup: what a shifted reading needs."""

    name = "spot"

    def forces(self, full: FullPlate, at: Snapshot) -> Array:
        s = full.specimen
        return np.column_stack(
            [
                full.loose.observe(
                    float(np.clip(x + dx, 0, s.length_m)), float(np.clip(y + dy, 0, s.width_m))
                )
                for x, y in s.pickups_m
                for dx, dy in _AROUND_M
            ]
        )


class SpotOffsetEffect(Effect):
    """Reading at (x + dx, y + dy)."""

    name = "spot_offset"
    enters = "observation"
    source = "shape functions at the shifted point"
    parameters: tuple[EffectParameter, ...] = (
        EffectParameter("dx", "m", -0.02, 0.02, 3e-3, spread=5e-3),
        EffectParameter("dy", "m", -0.02, 0.02, 3e-3, spread=5e-3),
    )
    spans: tuple[Span, ...] = (Spot(),)
    chance = 0.04
    discriminating_test = "a second spot, its distance to the first measured; an accelerometer under the spot"

    def on(self, kind: str) -> Effect | None:
        return SpotOnBeamEffect() if kind == "beam" else super().on(kind)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [self.parameters[0].typical * np.array([np.cos(a), np.sin(a)]) for a in _DIRECTIONS]

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        x, y = plate.pickup
        return Change(observe=plate.row(x + u[0], y + u[1]) - plate.row(x, y))

    def story(self, u: Mapping[str, float]) -> str:
        return f"the laser's spot is off by ({1e3 * u['dx']:+.1f}, {1e3 * u['dy']:+.1f}) mm along x and y"


class SpotOnBeamEffect(AlongABeam, SpotOffsetEffect):
    """Reading at x + dx of a beam."""

    parameters = SpotOffsetEffect.parameters[:1]
    spans = ()

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.array([self.parameters[0].typical])]

    def story(self, u: Mapping[str, float]) -> str:
        return f"the laser's spot is off by {1e3 * u['dx']:+.1f} mm along the beam"
