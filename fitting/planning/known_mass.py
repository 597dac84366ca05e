"""A mass of known size put at a known place, to see what it changes."""

import numpy as np

from fitting.arrays import Array
from fitting.effects.added_mass import AddedMassEffect
from fitting.effects.base import EffectParameter


class KnownMass(AddedMassEffect):
    """As an added mass, its place fixed."""

    name = "known_mass"

    def __init__(
        self, mass_kg: float, at_m: tuple[float, float], relative_error: float, off_m: float
    ) -> None:
        """Standard deviations: `relative_error` of the mass, `off_m` of each coordinate of its place."""
        self.values: Array = np.array([mass_kg, *at_m])
        self.off_m = off_m
        self.sigma_kg = relative_error * mass_kg
        mass, x, y = AddedMassEffect.parameters
        self.parameters = (
            mass,
            EffectParameter(x.key, x.unit, 0.0, np.inf, at_m[0], neutral=None, fixed=True),
            EffectParameter(y.key, y.unit, 0.0, np.inf, at_m[1], neutral=None, fixed=True),
        )

    def unknowns_on(self, length_m: float, longer_m: float) -> Array:
        """Its unknowns on a plate that was stretched to the stated length. Shape (3,)."""
        mass, x, y = self.values
        # It sits so far from the free end, wherever the clamp begins.
        return np.array([mass, (x + longer_m) * length_m / (length_m + longer_m), y])
