"""Layers that are not what the specimen file says, by more than its tolerances."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from fitting.arrays import Array
from instrument.campaign.draws import either_sign
from instrument.campaign.plates.geometry import TruePlate
from instrument.campaign.plates.hidden.base import Hidden, Setting, times
from instrument.campaign.plates.solid import Build


@dataclass(frozen=True)
class HiddenConstrainingStiffness(Hidden):
    """Young's modulus of the constraining layer."""

    name: ClassVar[str] = "constraining_stiffness"
    place: ClassVar[str] = "constraining layer"
    changes_solid: ClassVar[bool] = True

    scale: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenConstrainingStiffness":
        return cls(1 + either_sign(rng, 0.05, 0.1))

    def plate(self, true: TruePlate) -> TruePlate:
        c = true.constraining
        assert c is not None
        return replace(true, constraining=replace(c, young_pa=c.young_pa * self.scale))


@dataclass(frozen=True)
class HiddenConstrainingThickness(Hidden):
    """Thickness of the constraining layer."""

    name: ClassVar[str] = "constraining_thickness"
    place: ClassVar[str] = "constraining layer"
    changes_solid: ClassVar[bool] = True

    scale: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenConstrainingThickness":
        return cls(1 + either_sign(rng, 0.05, 0.1))

    def plate(self, true: TruePlate) -> TruePlate:
        c = true.constraining
        assert c is not None
        return replace(true, constraining=replace(c, thickness_m=c.thickness_m * self.scale))


@dataclass(frozen=True)
class HiddenSubstrateStiffness(Hidden):
    """Young's modulus of the substrate."""

    name: ClassVar[str] = "substrate_stiffness"
    place: ClassVar[str] = "substrate"
    changes_solid: ClassVar[bool] = True

    scale: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenSubstrateStiffness":
        return cls(1 + either_sign(rng, 0.04, 0.08))

    def plate(self, true: TruePlate) -> TruePlate:
        s = true.substrate
        return replace(true, substrate=replace(s, young_pa=s.young_pa * self.scale))

    def at_hammer(self, plate: TruePlate, build: Build) -> tuple[TruePlate, Build]:
        return self.plate(plate), build


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
        return cls(either_sign(rng, 0.03, 0.06))

    def plate(self, true: TruePlate) -> TruePlate:
        return replace(true, substrate=replace(true.substrate, rolled=self.rolled))

    def at_hammer(self, plate: TruePlate, build: Build) -> tuple[TruePlate, Build]:
        return self.plate(plate), build


@dataclass(frozen=True)
class HiddenCoreThickness(Hidden):
    """Thickness of the core."""

    name: ClassVar[str] = "core_thickness"
    place: ClassVar[str] = "core"
    changes_solid: ClassVar[bool] = True

    scale: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenCoreThickness":
        return cls(1 + either_sign(rng, 0.1, 0.15))

    def plate(self, true: TruePlate) -> TruePlate:
        c = true.core
        assert c is not None
        return replace(true, core=replace(c, thickness_m=c.thickness_m * self.scale))


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
        return cls(float(rng.uniform(0.08, 0.2)) * min(at.plate.length_m, at.plate.width_m))

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
