"""Stated numbers that a hammer test of the bare plate feels, and what they make of its coefficients."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.nuisances.stated_coefficients import PlateCoefficients
from fitting.nuisances.sums import Kept
from fitting.plate.parts import coefficients
from fitting.stated.patches import OF_PATCHES
from fitting.stated.tolerances import of_scope

_MOST_BARE = 512
"""Sets of a bare plate's few coefficients kept: derivatives about some twenty places of its numbers."""
_TREATMENT = ("constraining", "core", "glue", *OF_PATCHES)
_OF_A_MOUNTING = of_scope("mounting", "temperature")


@dataclass(frozen=True)
class BareNumbers:
    """Numbers of one treated plate that its bare plate has too."""

    stated: PlateCoefficients

    @cached_property
    def places(self) -> list[int]:
        """Where they are among all numbers of the fit."""
        each = self.stated.each
        return [k for k in self.stated.moving if not each[k].kind.startswith((*_TREATMENT, *_OF_A_MOUNTING))]

    def coefficients(self, z: Array) -> tuple[Array | Complex, Array]:
        """Of the bare plate's stiffness and mass, its length as stated, `z` of shape (count,).

        Shapes of `STIFFNESS` and `MASS`.
        """
        # A hammer test is a mounting of its own.
        at = np.zeros(len(self.stated.each))
        at[self.places] = z[self.places]
        c = self._kept.get("c", at, lambda: self._coefficients(at))
        stiff = self._stiff
        return c[:stiff], c[stiff:].real

    def _coefficients(self, z: Array) -> Array:
        c = coefficients(self.stated.moved_specimen(z).bare, self.stated.specimen.bare)
        return np.concatenate([c.K_0, c.M])

    @cached_property
    def _stiff(self) -> int:
        """How many parts the bare plate's K_0 has."""
        bare = self.stated.specimen.bare
        return len(coefficients(bare, bare).K_0)

    @cached_property
    def _kept(self) -> Kept:
        return Kept(_MOST_BARE)
