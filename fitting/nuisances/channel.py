"""The velocity channel's gain, delay and phase as unknowns of a fit: what they make of a velocity."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.nuisances.nuisance import Nuisance
from fitting.stated.tolerances import OF_CHANNELS


@dataclass(frozen=True)
class StatedChannel:
    """What a fit knows of it; `each` are all its numbers, in standard deviations."""

    each: Sequence[Nuisance]

    @cached_property
    def _known(self) -> dict[str, tuple[int, float]]:
        """Place and standard deviation of those that move."""
        return {n.name: (k, n.sigma) for k, n in enumerate(self.each) if n.name in OF_CHANNELS}

    def _moved(self, name: str, z: Array) -> Array:
        """By how much a number is off its stated value. Shapes (..., numbers) to (..., 1)."""
        if name not in self._known:
            return np.zeros((*z.shape[:-1], 1))
        k, sigma = self._known[name]
        return np.asarray(sigma * z[..., k, None])

    def factor(self, omega: Array, z: Array) -> Complex:
        """Of what it reads over the velocity. Shapes (points,) and (..., numbers) to (..., points)."""
        gain, delay, phase = (self._moved(name, z) for name in OF_CHANNELS)
        return np.asarray((1 + gain) * np.exp(1j * (phase - omega * delay)))

    def reading(self, v: Complex, omega: Array, z: Array) -> Complex:
        """What it makes of a velocity. Shapes (points,) and (numbers,)."""
        if not any(z[k] for k, _ in self._known.values()):
            return v
        return np.asarray(v * self.factor(omega, z))

    def by_reading(self, read: Complex, omega: Array, z: Array) -> dict[int, Complex]:
        """Derivatives of what has been read, by number. Shapes (..., points) and (..., numbers)."""
        found: dict[int, Complex] = {}
        if "gain" in self._known:
            k, sigma = self._known["gain"]
            found[k] = read * (sigma / (1 + self._moved("gain", z)))
        if "delay" in self._known:
            k, sigma = self._known["delay"]
            found[k] = read * (-1j * omega * sigma)
        if "phase" in self._known:
            k, sigma = self._known["phase"]
            found[k] = read * (1j * sigma)
        return found
