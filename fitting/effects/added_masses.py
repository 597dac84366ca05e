"""Two point masses on the plate: a sensor and its cable's clip, two reflectors."""

from collections.abc import Mapping
from itertools import combinations

import numpy as np

from fitting.arrays import Array
from fitting.effects.added_mass import AddedMassEffect, near
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import Points
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

_PLACES = [(x, y) for x in (0.4, 0.7, 0.97) for y in (0.2, 0.8)]
"""Shares of length and width. Fifteen pairs: most do little that the others do not."""
_START_KG = 3e-3
"""Each: half a small accelerometer."""


class AddedMassesEffect(Effect):
    """m_1 w^2 at (x_1, y_1) and m_2 w^2 at (x_2, y_2)."""

    name = "added_masses"
    enters = "mass"
    source = AddedMassEffect.source
    causes = 2
    parameters = tuple(
        EffectParameter(f"{key}_{number}", unit, lower, upper, typical, neutral=neutral, spread=spread)
        for number in (1, 2)
        for key, unit, lower, upper, typical, neutral, spread in (
            ("mass", "kg", 0.0, 0.05, 3e-3, 0.0, 5e-3),
            ("x", "m", 0.0, np.inf, 0.05, None, None),
            ("y", "m", 0.0, np.inf, 0.05, None, None),
        )
    )
    spans = AddedMassEffect.spans
    unexplained_share = AddedMassEffect.unexplained_share
    extends = "added_mass"
    twice = True
    chance = 0.005
    discriminating_test = AddedMassEffect.discriminating_test
    caution = AddedMassEffect.caution

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        places = [(x * plate.length_m, y * plate.width_m) for x, y in _PLACES]
        return [np.array([_START_KG, *a, _START_KG, *b]) for a, b in combinations(places, 2)]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = super().limits(plate)
        return lower, np.minimum(upper, [np.inf, plate.length_m, plate.width_m] * 2)

    def within(self, u: Array) -> tuple[tuple[Effect, Array], ...]:
        return tuple((AddedMassEffect(), u[k : k + 3]) for k in (0, 3))

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        one, other = (AddedMassEffect().change(plate, u[k : k + 3]) for k in (0, 3))
        return one.and_then(other)

    def story(self, u: Mapping[str, float]) -> str:
        both = (f"{1e3 * u[f'mass_{n}']:.2g} g {near(u, f'_{n}')}" for n in (1, 2))
        return f"two masses sit on the plate, {' and '.join(both)}"
