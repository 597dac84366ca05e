"""What moves the core's law during a run: warming, a chamber around it, and softening under strain."""

import numpy as np

from drivers.simulated.climate import AMBIENT_C, HIGHEST_C, LOWEST_C, Climate
from drivers.simulated.plant.effects import Effects, TemperatureDrift
from drivers.simulated.plant.law import MaxwellLaw, wlf_shift

_CORE = TemperatureDrift(kelvin=0.0)
"""Its c1 and c2_kelvin are the core's where none are given."""
LEAST_FACTOR = 0.3
"""Softening goes no further."""
BAND = 2 * np.pi * np.array([14.0, 30.0, 65.0, 140.0, 310.0])
"""Where a move of the modulus is judged, rad/s."""


class SlowChange:
    """The law at any time, with the softening followed so far."""

    def __init__(self, law: MaxwellLaw, effects: Effects, climate: Climate | None = None) -> None:
        self._climate = climate
        self._law, self._drift, self._softening = law, effects.temperature_drift, effects.amplitude_softening
        self._factor = 1.0

    @property
    def any(self) -> bool:
        """Whether anything moves at all."""
        return any(moves is not None for moves in (self._drift, self._softening, self._climate))

    def kelvin(self, time_s: float) -> float:
        """Above the reference temperature."""
        drift, climate = self._drift, self._climate
        own = drift.kelvin * -float(np.expm1(-time_s / drift.time_constant_s)) if drift else 0.0
        return own + climate.plate_c(time_s) - AMBIENT_C if climate else own

    def law(self, time_s: float) -> MaxwellLaw:
        """At a time, with the present softening."""
        law = self._law.scaled(self._factor)
        if self._drift is None and self._climate is None:
            return law
        return law.shifted(self._wlf(self.kelvin(time_s)))

    def extremes(self) -> tuple[MaxwellLaw, ...]:
        """Laws that enclose all that may come."""
        shifts, factors = [1.0], [1.0]
        if self._drift:
            shifts += [self._wlf(share * self._drift.kelvin) for share in (0.5, 1.0)]
        if self._climate:
            own = self._drift.kelvin if self._drift else 0.0
            around = (LOWEST_C - AMBIENT_C + min(own, 0.0), HIGHEST_C - AMBIENT_C + max(own, 0.0))
            shifts += [self._wlf(share * kelvin) for kelvin in around for share in (0.5, 1.0)]
        if self._softening:
            factors += [0.8, 0.55]
        return tuple(self._law.shifted(s).scaled(f) for s in shifts for f in factors)

    def _wlf(self, kelvin: float) -> float:
        core = self._drift or _CORE
        return wlf_shift(kelvin, core.c1, core.c2_kelvin)

    def follow(self, strain: float, seconds: float) -> None:
        """Let the softening move towards the factor of a steady strain."""
        soft = self._softening
        if soft is not None:
            goal = max(1 - soft.k * strain / soft.reference_strain, LEAST_FACTOR)
            self._factor += (goal - self._factor) * -float(np.expm1(-seconds / soft.time_constant_s))

    def moved(self, before: MaxwellLaw, after: MaxwellLaw) -> float:
        """Largest relative change of G* over the band."""
        return float(np.max(np.abs(after.modulus(BAND) / before.modulus(BAND) - 1)))
