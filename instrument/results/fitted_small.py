"""The response of a law and a beam or shear pair that were found: their matrices are solved anew."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.identification.model import velocity
from fitting.laws import CoreLaw
from fitting.structures.small import SmallNuisances, SmallSpecimen, displacement, system_of
from instrument.results.fit_file import FoundLaw

_STEP = 1e-4
"""Relative in G*, and in standard deviations of a stated number: the response is smooth in both."""


@dataclass(frozen=True)
class FittedSmall:
    """A law and a structure, its stated numbers moved by `z` in standard deviations of their tolerances."""

    specimen: SmallSpecimen
    law: CoreLaw
    nuisances: SmallNuisances
    z: Array

    @classmethod
    def of(cls, specimen: SmallSpecimen, found: FoundLaw) -> "FittedSmall":
        """Law and stated numbers as a fit has left them. Raises `BadInput` for a law of another kind."""
        assert specimen.core is not None
        both = [one.moved(specimen) for one in found.of_specimen]
        nuisances = SmallNuisances(specimen, tuple(n for n, _ in both), None, specimen.parts())
        return cls(
            specimen, found.law(specimen.core.law), nuisances, np.array([z for _, z in both], dtype=float)
        )

    @property
    def names(self) -> Sequence[str]:
        """Of all that is known with an error."""
        return [*self.law.names, *(n.name for n in self.nuisances.each)]

    def velocity(self, frequency_hz: Array) -> Complex:
        """What the velocity channel reads, m/s. Shape (points,)."""
        omega = 2 * np.pi * np.asarray(frequency_hz, dtype=float)
        return self._read(omega, self.law.modulus(omega), self.z)

    def derivatives(self, frequency_hz: Array) -> Complex:
        """Of the velocity, to all that `names` lists. Shape (names, points)."""
        omega = 2 * np.pi * np.asarray(frequency_hz, dtype=float)
        G = self.law.modulus(omega)
        above, below = (self._read(omega, (1 + s) * G, self.z) for s in (_STEP, -_STEP))
        by_law = (above - below) / (2 * _STEP * G) * self.law.jacobian(omega) * self.law.values[:, None]
        rows = [by_law]
        for step in _STEP * np.eye(len(self.z)):
            difference = self._read(omega, G, self.z + step) - self._read(omega, G, self.z - step)
            rows.append(difference[None] / (2 * _STEP))
        return np.concatenate(rows)

    def _read(self, omega: Array, G: Complex, z: Array) -> Complex:
        s, parts = self.specimen, self.nuisances.parts
        assert parts is not None
        numbers = set(s.numbers)
        by = {
            n.name: n.sigma * float(at)
            for n, at in zip(self.nuisances.each, z, strict=True)
            if n.kind in numbers
        }
        x = displacement(self.nuisances.placed(system_of(s, parts, by), z), omega, G)
        return self.nuisances.reading(velocity(omega, x, s.reads) * s.drive_amplitude, omega, z)
