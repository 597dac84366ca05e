"""A piece of the plate is gone: a corner that broke off, a hole. Its mass is missing.

What it lacks in stiffness is not counted: near a free edge a plate hardly bends. Of a hole far from one it
would matter too.
"""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array
from fitting.effects.added_mass import PLACE, PointMass, near
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.span import Span

_START_KG = 2e-3
"""To begin with."""
_MOST = 0.05
"""Largest share of the plate's mass that may be missing."""
_ALONG, _ACROSS = (0.3, 0.5, 0.7, 0.95), (0.05, 0.3, 0.5, 0.7, 0.95)
"""Shares of length and width, to begin with: the corners of the free end, edges, holes in the middle."""
_AT, _WEIGHT = np.polynomial.legendre.leggauss(3)
"""Gauss's places from -1 to 1, and their weights, which sum to 2."""


class MissingPieceEffect(Effect):
    """Less m w^2, over a square near (x, y) that is so heavy; at an edge of the plate it ends there."""

    name = "missing_piece"
    enters = "mass"
    source = "the plate's own kinetic energy over the piece"
    parameters: tuple[EffectParameter, ...] = (
        EffectParameter("mass", "kg", 0.0, 1.0, _START_KG, spread=3e-3),
        *PLACE,
    )
    spans: tuple[Span, ...] = (PointMass(),)
    unexplained_share = 0.003
    chance = 0.005
    discriminating_test = "a look at the plate and a balance"

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        m = min(_START_KG, self.limits(plate)[1][0])
        return [np.array([m, x * plate.length_m, y * plate.width_m]) for x in _ALONG for y in _ACROSS]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = super().limits(plate)
        most = _MOST * _kg_m2(plate) * plate.length_m * plate.width_m
        return lower, np.minimum(upper, [most, plate.length_m, plate.width_m])

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        half = np.sqrt(max(u[0], 0.0) / _kg_m2(plate)) / 2
        # No more is gone than was there: at the plate's edge the square still lies within it.
        sides = np.array([plate.length_m, plate.width_m])
        x, y = half + (1 - 2 * half / sides) * u[1:]
        rows = np.array([plate.row(x + s * half, y + t * half) for s in _AT for t in _AT])
        share = np.outer(_WEIGHT, _WEIGHT).ravel() / 4
        return Change(M=-u[0] * (rows.T * share) @ rows, load=u[0] * share @ rows)

    def story(self, u: Mapping[str, float]) -> str:
        return f"{1e3 * u['mass']:.2g} g of the plate are gone {near(u)}"


def _kg_m2(plate: EnrichedReducedPlate) -> float:
    """All layers of it, as stated."""
    s = plate.specimen
    layers = (s.substrate, s.core, s.constraining)
    return float(sum(k.thickness_m * k.density_kg_m3 for k in layers if k is not None))
