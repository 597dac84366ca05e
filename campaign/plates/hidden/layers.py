"""Layers that are not what the specimen file says, by more than its tolerances."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.draws import either_sign
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.base import Hidden, Setting, times
from campaign.plates.hidden.scaled import (
    ConstrainingStiffness,
    ConstrainingThickness,
    CoreThickness,
    ScaledLayer,
    SubstrateStiffness,
)
from campaign.plates.solid import Build
from fitting.arrays import Array

_ROLLED = (0.03, 0.06)
"""Difference of a sheet's moduli over their mean: three tolerances of a modulus and more."""
_GONE = (0.08, 0.2)
"""Side of a corner that is gone, of the shorter side."""


@dataclass(frozen=True)
class _ScaledInPlate(ScaledLayer, Hidden):
    """One number of one layer by a factor."""

    changes_solid: ClassVar[bool] = True

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "_ScaledInPlate":
        return cls(1 + either_sign(rng, *cls.sizes))

    def plate(self, true: TruePlate) -> TruePlate:
        return self.scaled(true)


@dataclass(frozen=True)
class HiddenConstrainingStiffness(ConstrainingStiffness, _ScaledInPlate):
    """A constraining layer of another alloy, or of another sheet."""

    place: ClassVar[str] = "constraining layer"


@dataclass(frozen=True)
class HiddenConstrainingThickness(ConstrainingThickness, _ScaledInPlate):
    """A constraining layer of another gauge than it is sold as."""

    place: ClassVar[str] = "constraining layer"


@dataclass(frozen=True)
class HiddenSubstrateStiffness(SubstrateStiffness, _ScaledInPlate):
    """The bare plate that is struck has it too."""

    place: ClassVar[str] = "substrate"

    def at_hammer(self, plate: TruePlate, build: Build) -> tuple[TruePlate, Build]:
        return self.plate(plate), build


@dataclass(frozen=True)
class HiddenCoreThickness(CoreThickness, _ScaledInPlate):
    """A core that was pressed or filled otherwise than it is stated."""

    place: ClassVar[str] = "core"


@dataclass(frozen=True)
class HiddenOrthotropicSubstrate(Hidden):
    """A rolled sheet: stiffer along x than along y, or the other way round."""

    name: ClassVar[str] = "orthotropic_substrate"
    place: ClassVar[str] = "substrate"
    changes_solid: ClassVar[bool] = True

    rolled: float
    """Difference of both moduli over their mean."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenOrthotropicSubstrate":
        return cls(either_sign(rng, *_ROLLED))

    def plate(self, true: TruePlate) -> TruePlate:
        return replace(true, substrate=replace(true.substrate, rolled=self.rolled))

    def at_hammer(self, plate: TruePlate, build: Build) -> tuple[TruePlate, Build]:
        return self.plate(plate), build


@dataclass(frozen=True)
class HiddenMissingPiece(Hidden):
    """A corner of the free end is gone, all layers of it."""

    name: ClassVar[str] = "missing_piece"
    place: ClassVar[str] = "mass"
    changes_solid: ClassVar[bool] = True

    side_m: float
    """Of the square that is gone, at the free end and y = 0."""

    left: ClassVar[float] = 0.01
    """Of stiffness and mass there: where nothing is left at all no motion is determined."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenMissingPiece":
        return cls(float(rng.uniform(*_GONE)) * min(at.plate.length_m, at.plate.width_m))

    def build(self, build: Build, true: TruePlate) -> Build:
        start = true.length_m - self.side_m

        def factor(x: Array, y: Array) -> Array:
            return np.where((x > start) & (y < self.side_m), self.left, 1.0)

        return replace(
            build,
            whole_factor=times(build.whole_factor, factor),
            lines_x_m=(*build.lines_x_m, start),
            lines_y_m=(*build.lines_y_m, self.side_m),
        )
