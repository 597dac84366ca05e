"""Coefficients of a structure's parts as functions of its stated numbers, and their derivatives.

`z` has shape (count,) throughout: all numbers of a fit, in standard deviations of their tolerances.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from fitting.arrays import Array
from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.sums import Kept
from fitting.plate.part_counts import PartCounts
from fitting.plate.part_names import names_of
from fitting.plate.parts import coefficients
from fitting.plate.plate_numbers import moved
from fitting.specimen import PlateSpecimen
from fitting.stated.tolerances import PLATE

STEP = 1e-2
"""Step of differences, in standard deviations."""
_FELT = 0.3
"""Standard deviations from which a plate's derivatives to stated numbers are taken to vary."""


@dataclass(frozen=True)
class StatedCoefficients(ABC):
    """Coefficients of K_0, K_1, M and the load, one after another."""

    each: tuple[Nuisance, ...]
    """All numbers of the fit."""
    load_sign: ClassVar[float]
    """Of the load in its parts: the coefficients times them are the load, or its negative."""

    @property
    @abstractmethod
    def counts(self) -> PartCounts:
        """How many parts K_0, K_1 and M have; those of the load follow them."""

    @cached_property
    @abstractmethod
    def moving(self) -> list[int]:
        """Places in `each` of the numbers that move coefficients."""

    @abstractmethod
    def at(self, z: Array) -> Array:
        """Coefficients of all parts and the load. Shape (parts + loads,)."""

    @cached_property
    @abstractmethod
    def as_stated(self) -> Array:
        """Coefficients of the structure whose parts they multiply. Shape (parts + loads,)."""

    @abstractmethod
    def by(self, z: Array) -> Array:
        """Derivatives of `at`, as good as a sweep's fit needs. Shape (count, parts + loads)."""

    def change(self, z: Array) -> Array:
        """What `at` is above `as_stated`. Shape (parts + loads,)."""
        return self._kept.get("c", z, lambda: self.at(z) - self.as_stated)

    def by_there(self, z: Array) -> Array:
        """Exact derivatives at `z`; a stiff core needs them, as its parts cancel to 1/1000.

        Shape (count, parts + loads).
        """
        return self._kept.get("dc there", z, lambda: self._differences(z))

    @cached_property
    def sigma(self) -> Array:
        """Standard deviations. Shape (count,)."""
        return np.array([n.sigma for n in self.each], dtype=float)

    @cached_property
    def _kept(self) -> Kept:
        return Kept()

    @abstractmethod
    def _differences(self, z: Array) -> Array:
        """Derivatives at `z` by central differences. Shape (count, parts + loads)."""


@dataclass(frozen=True)
class PlateCoefficients(StatedCoefficients):
    """Coefficients of a plate on the mesh and the parts of another one like it."""

    specimen: PlateSpecimen
    reference: PlateSpecimen
    load_sign: ClassVar[float] = -1.0

    @property
    def counts(self) -> PartCounts:
        """How many parts K_0, K_1 and M have; those of the load follow them."""
        return self._counts

    @cached_property
    def _counts(self) -> PartCounts:
        return names_of(self.reference).counts

    @cached_property
    def moving(self) -> list[int]:
        """Places in `each` of the numbers that change the plate's matrices."""
        return [k for k, n in enumerate(self.each) if n.kind in PLATE]

    @cached_property
    def as_stated(self) -> Array:
        """Coefficients of the reference. Shape (parts + loads,)."""
        return np.asarray(coefficients(self.reference, self.reference).all)

    def moved_specimen(self, z: Array) -> PlateSpecimen:
        """The specimen, the numbers of its plate moved by `z` standard deviations. Shape (count,)."""
        names = [self.each[k].name for k in self.moving]
        return moved(self.specimen, names, (self.sigma * z)[self.moving].tolist())

    def at(self, z: Array) -> Array:
        """Coefficients of all parts and the load. Shape (parts + loads,).

        Complex where a face has a loss factor.
        """
        return np.asarray(coefficients(self.moved_specimen(z), self.reference).all)

    def by(self, z: Array) -> Array:
        """Derivatives of `at`, as far as these vary linearly with each. Shape (count, parts + loads).

        Accurate to 2 % for a soft core; exact derivatives at every step would be too slow.
        """
        return self._kept.get("dc", z, lambda: self._nearly_by(z))

    def _nearly_by(self, z: Array) -> Array:
        found = self._by_as_stated
        for k in self.moving:
            if abs(z[k]) > _FELT:
                found = found + z[k] * self._second(k)
        return found

    @cached_property
    def _by_as_stated(self) -> Array:
        return self._differences(np.zeros(len(self.each)))

    def _second(self, k: int) -> Array:
        """How derivatives vary with one number."""
        step = np.zeros(len(self.each))
        step[k] = 1.0
        return self._kept_differences.get(
            "ddc", step, lambda: (self._differences(step) - self._differences(-step)) / 2
        )

    @cached_property
    def _kept_differences(self) -> Kept:
        # Few entries, each expensive to compute.
        return Kept()

    def _differences(self, z: Array) -> Array:
        by = {}
        for k in self.moving:
            up, down = z.copy(), z.copy()
            up[k], down[k] = z[k] + STEP, z[k] - STEP
            by[k] = (self.at(up) - self.at(down)) / (2 * STEP)
        # A face's loss factor makes some coefficients complex.
        found = np.zeros((len(self.each), len(self.as_stated)), np.result_type(self.as_stated, *by.values()))
        for k, row in by.items():
            found[k] = row
        return found
