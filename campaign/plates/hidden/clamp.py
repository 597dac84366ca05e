"""A clamp that yields, at its bolts or unevenly, bites elsewhere, or leaves the treatment free."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.draws import either_sign, log_uniform
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.base import Hidden, Setting
from campaign.plates.hidden.sizes import ACROSS, CLAMP_LINE_M, FRICTION_LOSS
from campaign.plates.solid import Build, RootSprings
from fitting.arrays import Array

BOLTS = (3, 6)
"""How many: at least, and one more than at most."""
REACH = (0.12, 0.25)
"""Standard deviation of a bolt's hold, over the distance between bolts: a few plate thicknesses."""
BETWEEN = (0.15, 0.5)
"""What is left of the hold between bolts, if the jaw is stiff or soft."""
_SOFT, _SOFT_UNEVEN = (0.0012, 0.008), (0.0012, 0.007)
"""Softness of a root: the first mode falls by twice as much, which is more than tolerances take up."""
_UNEVEN = (1.5, 3.5)
"""ln of the ratio of both edges: four to thirty times better held on one."""
_SHORT_M = (1e-3, 3e-3)
"""How far a treatment ends short of the jaw, where it does not end at it."""


def _springs(at: Setting, softness: float) -> float:
    """Per area, such that softness = D / (rotation spring x length): half of the fall of mode 1."""
    return at.plate.substrate.young_pa / (softness * at.plate.length_m)


@dataclass(frozen=True)
class HiddenClampCompliance(Hidden):
    """A row of bolts, each holding a few plate thicknesses to its sides, over a softer jaw."""

    name: ClassVar[str] = "clamp_compliance"
    place: ClassVar[str] = "clamp"
    changes_solid: ClassVar[bool] = True

    along_x_n_m3: float
    """At a bolt, per area of the root face."""
    along_z_n_m3: float
    bolts: int
    reach_m: float
    """Standard deviation of a bolt's hold along y."""
    between: float
    """What is left between bolts."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenClampCompliance":
        along_x = _springs(at, log_uniform(rng, *_SOFT))
        bolts = int(rng.integers(*BOLTS))
        reach = float(rng.uniform(*REACH)) * at.plate.width_m / bolts
        return cls(along_x, along_x * log_uniform(rng, *ACROSS), bolts, reach, float(rng.uniform(*BETWEEN)))

    def build(self, build: Build, true: TruePlate) -> Build:
        places = true.width_m * (np.arange(self.bolts) + 0.5) / self.bolts

        def hold(y: Array) -> Array:
            bolts = np.exp(-(((y[..., None] - places) / self.reach_m) ** 2) / 2).sum(axis=-1)
            return np.asarray(self.between + (1 - self.between) * bolts)

        springs = RootSprings(lambda y: self.along_x_n_m3 * hold(y), lambda y: self.along_z_n_m3 * hold(y))
        return replace(build, root=springs)


@dataclass(frozen=True)
class HiddenClampFriction(HiddenClampCompliance):
    """The clamp yields as in `HiddenClampCompliance`, and rubs: every spring has a loss factor."""

    name: ClassVar[str] = "clamp_friction"

    loss: float = 0.0

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenClampFriction":
        held = HiddenClampCompliance.draw(rng, at)
        return cls(**held.facts, loss=float(rng.uniform(*FRICTION_LOSS)))

    def build(self, build: Build, true: TruePlate) -> Build:
        held = super().build(build, true)
        assert held.root is not None
        return replace(held, root=replace(held.root, loss=self.loss))


@dataclass(frozen=True)
class HiddenUnevenClamp(Hidden):
    """The clamp holds one edge of the plate better than the other."""

    name: ClassVar[str] = "uneven_clamp"
    place: ClassVar[str] = "clamp"
    near: ClassVar[tuple[str, ...]] = ("clamp_compliance",)
    changes_solid: ClassVar[bool] = True

    middle_n_m3: float
    """Per area of the root face, along x and z alike."""
    slope: float
    """ln of the ratio of both edges."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenUnevenClamp":
        return cls(_springs(at, log_uniform(rng, *_SOFT_UNEVEN)), either_sign(rng, *_UNEVEN))

    def build(self, build: Build, true: TruePlate) -> Build:
        def hold(y: Array) -> Array:
            return np.asarray(self.middle_n_m3 * np.exp(self.slope * (y / true.width_m - 0.5)))

        return replace(build, root=RootSprings(hold, hold))


@dataclass(frozen=True)
class HiddenClampLine(Hidden):
    """The plate bends from another line than the jaw's visible edge: length and spot count from there."""

    name: ClassVar[str] = "clamp_line"
    place: ClassVar[str] = "clamp"
    changes_solid: ClassVar[bool] = True

    longer_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenClampLine":
        return cls(either_sign(rng, *CLAMP_LINE_M))

    def plate(self, true: TruePlate) -> TruePlate:
        x, y = true.spot_m
        return replace(true, length_m=true.length_m + self.longer_m, spot_m=(x + self.longer_m, y))

    def spot(self, spot_m: tuple[float, float], true: TruePlate) -> tuple[float, float]:
        return spot_m[0] + self.longer_m, spot_m[1]


@dataclass(frozen=True)
class HiddenTreatmentNotGripped(Hidden):
    """The clamp holds the substrate alone; core and constraining layer end at it or short of it."""

    name: ClassVar[str] = "treatment_not_gripped"
    place: ClassVar[str] = "clamp"
    changes_solid: ClassVar[bool] = True

    begins_m: float
    """Distance of the treatment from the clamp."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenTreatmentNotGripped":
        return cls(0.0 if rng.random() < 0.5 else float(rng.uniform(*_SHORT_M)))

    def build(self, build: Build, true: TruePlate) -> Build:
        return replace(build, treatment_from_m=self.begins_m)
