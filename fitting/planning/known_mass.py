"""A mass of known size put at a known place, to see what it changes."""

import numpy as np

from fitting.arrays import Array
from fitting.effects.added_mass import AddedMassEffect
from fitting.effects.base import EffectParameter


class KnownMass(AddedMassEffect):
    """As an added mass, its place fixed."""

    name = "known_mass"

    def __init__(self, mass_kg: float, at_m: tuple[float, float], relative_error: float) -> None:
        """`relative_error` is the standard deviation of the mass as it is known."""
        self.values: Array = np.array([mass_kg, *at_m])
        self.sigma_kg = relative_error * mass_kg
        mass, x, y = AddedMassEffect.parameters
        self.parameters = (
            mass,
            EffectParameter(x.key, x.unit, 0.0, np.inf, at_m[0], neutral=None, fixed=True),
            EffectParameter(y.key, y.unit, 0.0, np.inf, at_m[1], neutral=None, fixed=True),
        )
