"""What moves the core's law during a run: warming, and softening under strain."""

import numpy as np

from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.law import MaxwellLaw, wlf_shift

LEAST_FACTOR = 0.3
"""Softening goes no further."""
BAND = 2 * np.pi * np.array([14.0, 30.0, 65.0, 140.0, 310.0])
"""Where a move of the modulus is judged, rad/s."""


class SlowChange:
    """The law at any time, with the softening followed so far."""

    def __init__(self, law: MaxwellLaw, effects: Effects) -> None:
        self._law, self._drift, self._softening = law, effects.temperature_drift, effects.amplitude_softening
        self._factor = 1.0

    @property
    def any(self) -> bool:
        """Whether anything moves at all."""
        return self._drift is not None or self._softening is not None

    def kelvin(self, time_s: float) -> float:
        """Above the reference temperature."""
        drift = self._drift
        return drift.kelvin * -float(np.expm1(-time_s / drift.time_constant_s)) if drift else 0.0

    def law(self, time_s: float) -> MaxwellLaw:
        """At a time, with the present softening."""
        law = self._law.scaled(self._factor)
        if self._drift is None:
            return law
        return law.shifted(wlf_shift(self.kelvin(time_s), self._drift.c1, self._drift.c2_kelvin))

    def extremes(self) -> tuple[MaxwellLaw, ...]:
        """Laws that enclose all that may come."""
        shifts, factors = [1.0], [1.0]
        if self._drift:
            ends = (0.5 * self._drift.kelvin, self._drift.kelvin)
            shifts += [wlf_shift(k, self._drift.c1, self._drift.c2_kelvin) for k in ends]
        if self._softening:
            factors += [0.8, 0.55]
        return tuple(self._law.shifted(s).scaled(f) for s in shifts for f in factors)

    def follow(self, strain: float, seconds: float) -> None:
        """Let the softening move towards the factor of a steady strain."""
        soft = self._softening
        if soft is not None:
            goal = max(1 - soft.k * strain / soft.reference_strain, LEAST_FACTOR)
            self._factor += (goal - self._factor) * -float(np.expm1(-seconds / soft.time_constant_s))

    def moved(self, before: MaxwellLaw, after: MaxwellLaw) -> float:
        """Largest relative change of G* over the band."""
        return float(np.max(np.abs(after.modulus(BAND) / before.modulus(BAND) - 1)))
