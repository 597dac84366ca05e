"""Stated numbers of several files as one set of unknowns."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.nuisances.nuisances import Nuisances
from fitting.specimen import PlacedMass


@dataclass(frozen=True)
class SharedNuisances(Nuisances):
    """Of all files; a hammer test is of the first one's bare plate."""

    first: Nuisances = field(kw_only=True, compare=False)
    places: NDArray[np.intp] = field(kw_only=True, compare=False)
    """Of the first file's among all."""

    @property
    def masses(self) -> tuple[PlacedMass, ...]:
        """Known masses placed on the first file's plate."""
        return self.first.masses

    @cached_property
    def of_bare_plate(self) -> list[int]:
        """Numbers that a hammer test of the bare plate feels."""
        return [int(self.places[k]) for k in self.first.of_bare_plate]

    def bare_coefficients(self, z: Array) -> tuple[Array | Complex, Array]:
        """As `Nuisances.bare_coefficients`, of the first file's plate."""
        return self.first.bare_coefficients(z[self.places])
