"""Layers that are not what the specimen file says, by more than its tolerances."""

from dataclasses import dataclass

import numpy as np

from campaign.beams.geometry import TrueBeam
from campaign.beams.hidden.base import HiddenInBeam, Setting
from campaign.draws import either_sign
from campaign.plates.hidden.scaled import (
    ConstrainingStiffness,
    ConstrainingThickness,
    CoreThickness,
    ScaledLayer,
    SubstrateStiffness,
)


@dataclass(frozen=True)
class _ScaledInBeam(ScaledLayer, HiddenInBeam):
    """One number of one layer by a factor."""

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return getattr(beam, cls.layer) is not None

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "_ScaledInBeam":
        return cls(1 + either_sign(rng, *cls.sizes))

    def beam(self, true: TrueBeam) -> TrueBeam:
        return self.scaled(true)


@dataclass(frozen=True)
class HiddenSubstrateStiffness(SubstrateStiffness, _ScaledInBeam):
    """A beam's substrate is stiffer or softer than stated."""


@dataclass(frozen=True)
class HiddenConstrainingStiffness(ConstrainingStiffness, _ScaledInBeam):
    """Of a beam that has such a layer."""


@dataclass(frozen=True)
class HiddenConstrainingThickness(ConstrainingThickness, _ScaledInBeam):
    """Of a beam that has such a layer."""


@dataclass(frozen=True)
class HiddenCoreThickness(CoreThickness, _ScaledInBeam):
    """Of a beam, a free layer's too."""
