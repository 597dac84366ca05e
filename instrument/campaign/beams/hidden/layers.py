"""Layers that are not what the specimen file says, by more than its tolerances."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from instrument.campaign.beams.geometry import TrueBeam
from instrument.campaign.beams.hidden.base import HiddenInBeam, Setting
from instrument.campaign.draws import either_sign


@dataclass(frozen=True)
class _Scaled(HiddenInBeam):
    """One number of one layer by a factor."""

    layer: ClassVar[str]
    number: ClassVar[str]
    sizes: ClassVar[tuple[float, float]]

    scale: float

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return getattr(beam, cls.layer) is not None

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "_Scaled":
        return cls(1 + either_sign(rng, *cls.sizes))

    def beam(self, true: TrueBeam) -> TrueBeam:
        layer = getattr(true, self.layer)
        scaled = replace(layer, **{self.number: self.scale * getattr(layer, self.number)})
        return replace(true, **{self.layer: scaled})


@dataclass(frozen=True)
class HiddenSubstrateStiffness(_Scaled):
    """Young's modulus of the substrate."""

    name: ClassVar[str] = "substrate_stiffness"
    layer: ClassVar[str] = "substrate"
    number: ClassVar[str] = "young_pa"
    sizes: ClassVar[tuple[float, float]] = (0.04, 0.08)


@dataclass(frozen=True)
class HiddenConstrainingStiffness(_Scaled):
    """The same of the constraining layer."""

    name: ClassVar[str] = "constraining_stiffness"
    layer: ClassVar[str] = "constraining"
    number: ClassVar[str] = "young_pa"
    sizes: ClassVar[tuple[float, float]] = (0.05, 0.1)


@dataclass(frozen=True)
class HiddenConstrainingThickness(_Scaled):
    """Thickness of the constraining layer."""

    name: ClassVar[str] = "constraining_thickness"
    layer: ClassVar[str] = "constraining"
    number: ClassVar[str] = "thickness_m"
    sizes: ClassVar[tuple[float, float]] = (0.05, 0.1)


@dataclass(frozen=True)
class HiddenCoreThickness(_Scaled):
    """Thickness of the core."""

    name: ClassVar[str] = "core_thickness"
    layer: ClassVar[str] = "core"
    number: ClassVar[str] = "thickness_m"
    sizes: ClassVar[tuple[float, float]] = (0.1, 0.15)
