"""Faults of a plate that no catalogue has: a diagnosis should say that it does not know."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.base import Hidden, Setting, times
from campaign.plates.hidden.sizes import LOOSENED
from campaign.plates.solid import Build, Patch
from fitting.arrays import Array

_CRACK_X, _CRACK_REACHES = (0.08, 0.5), (0.3, 0.7)
"""Where it is, of the length, since plates break near their clamp; and how far it goes, of the width."""
_CRACK_HALF, _CRACK_LEFT = 0.5, (0.15, 0.4)
"""Half of the soft line's width, of the thickness; what is left of the stiffness: it does not go through."""
_WAVY, _WAVY_LOST = (0.06, 0.12), (0.4, 0.75)
"""Size of the wavy region, of the length; and what a wave takes of its stiffness."""
_BLISTER, _BLISTER_EDGE = (0.08, 0.2), (0.1, 0.3)
"""Radius of a blister, of the shorter side; and of that radius, over what the bond recovers."""
_STUCK_ON = (1.0, 4.0)
"""What sticks on, over the constraining layer under it."""


@dataclass(frozen=True)
class HiddenCrackedSubstrate(Hidden):
    """A soft line across part of the substrate, from one long edge."""

    name: ClassVar[str] = "cracked_substrate"
    place: ClassVar[str] = "strange"
    in_catalogue: ClassVar[bool] = False
    changes_solid: ClassVar[bool] = True

    x_m: float
    reaches_m: float
    """From the edge y = 0."""
    half_width_m: float
    left: float
    """Of the stiffness within."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenCrackedSubstrate":
        length, width = at.plate.length_m, at.plate.width_m
        return cls(
            float(rng.uniform(*_CRACK_X)) * length,
            float(rng.uniform(*_CRACK_REACHES)) * width,
            _CRACK_HALF * at.plate.substrate.thickness_m,
            float(rng.uniform(*_CRACK_LEFT)),
        )

    def _with_crack(self, build: Build) -> Build:
        def factor(x: Array, y: Array) -> Array:
            inside = (np.abs(x - self.x_m) < self.half_width_m) & (y < self.reaches_m)
            return np.where(inside, self.left, 1.0)

        ends = (self.x_m - self.half_width_m, self.x_m + self.half_width_m)
        return replace(
            build,
            substrate_factor=times(build.substrate_factor, factor),
            lines_x_m=(*build.lines_x_m, *ends),
            lines_y_m=(*build.lines_y_m, self.reaches_m),
        )

    def build(self, build: Build, true: TruePlate) -> Build:
        return self._with_crack(build)

    def at_hammer(self, plate: TruePlate, build: Build) -> tuple[TruePlate, Build]:
        return plate, self._with_crack(build)


@dataclass(frozen=True)
class HiddenWrinkledConstraining(Hidden):
    """The constraining layer is wavy in one region and stretches there more easily."""

    name: ClassVar[str] = "wrinkled_constraining"
    place: ClassVar[str] = "strange"
    near: ClassVar[tuple[str, ...]] = ("partial_debond",)
    in_catalogue: ClassVar[bool] = False
    changes_solid: ClassVar[bool] = True

    x_m: float
    y_m: float
    size_m: float
    """Standard deviation of the region along x; along y it is twice as wide."""
    lost: float
    """Of the stiffness in its middle."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenWrinkledConstraining":
        length, width = at.plate.length_m, at.plate.width_m
        x, y = length * rng.uniform(0.15, 0.7), width * rng.uniform(0.2, 0.8)
        return cls(float(x), float(y), length * float(rng.uniform(*_WAVY)), float(rng.uniform(*_WAVY_LOST)))

    def build(self, build: Build, true: TruePlate) -> Build:
        def factor(x: Array, y: Array) -> Array:
            away = ((x - self.x_m) / self.size_m) ** 2 + ((y - self.y_m) / (2 * self.size_m)) ** 2
            return np.asarray(1 - self.lost * np.exp(-away / 2))

        return replace(build, constraining_factor=times(build.constraining_factor, factor))


@dataclass(frozen=True)
class HiddenBlister(Hidden):
    """Air under the treatment: the core holds to nothing in a round spot."""

    name: ClassVar[str] = "blister"
    place: ClassVar[str] = "core"
    near: ClassVar[tuple[str, ...]] = ("partial_debond",)
    in_catalogue: ClassVar[bool] = False
    changes_solid: ClassVar[bool] = True

    x_m: float
    y_m: float
    radius_m: float
    edge_m: float
    """Over which the bond recovers."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenBlister":
        sides = np.array([at.plate.length_m, at.plate.width_m])
        radius = float(rng.uniform(*_BLISTER) * sides.min())
        x, y = (rng.uniform(0.05, 0.95, 2) * sides).tolist()
        return cls(x, y, radius, radius * float(rng.uniform(*_BLISTER_EDGE)))

    def build(self, build: Build, true: TruePlate) -> Build:
        def factor(x: Array, y: Array) -> Array:
            away = np.hypot(x - self.x_m, y - self.y_m)
            return np.asarray(1 - LOOSENED * (1 - np.tanh((away - self.radius_m) / self.edge_m)) / 2)

        return replace(build, core_factor=times(build.core_factor, factor))


@dataclass(frozen=True)
class HiddenStiffener(Hidden):
    """A strip that somebody stuck on: a label, a strain gauge's carrier. Stiff where it is, and heavy."""

    name: ClassVar[str] = "stiffener"
    place: ClassVar[str] = "strange"
    in_catalogue: ClassVar[bool] = False
    changes_solid: ClassVar[bool] = True

    from_m: tuple[float, float]
    to_m: tuple[float, float]
    """Its corners, x and y."""
    factor: float
    """On the constraining layer's stiffness under it."""
    mass_kg: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenStiffener":
        sides = np.array([at.plate.length_m, at.plate.width_m])
        size = sides * rng.uniform([0.1, 0.2], [0.3, 0.6])
        corner = rng.uniform([0.1, 0.0], [0.6, 0.4]) * sides
        constraining = at.plate.constraining
        assert constraining is not None
        more = float(rng.uniform(*_STUCK_ON))
        under = float(np.prod(size)) * constraining.thickness_m * constraining.density_kg_m3
        first, last = corner.tolist(), (corner + size).tolist()
        return cls((first[0], first[1]), (last[0], last[1]), 1 + more, more * under)

    def build(self, build: Build, true: TruePlate) -> Build:
        (x_0, y_0), (x_1, y_1) = self.from_m, self.to_m

        def factor(x: Array, y: Array) -> Array:
            return np.where((x > x_0) & (x < x_1) & (y > y_0) & (y < y_1), self.factor, 1.0)

        # Its mass in as many squares as it is longer than wide.
        lengths = np.array([x_1 - x_0, y_1 - y_0])
        count = max(1, round(lengths.max() / lengths.min()))
        side = min(lengths.min(), lengths.max() / count)
        along = np.where(lengths == lengths.max(), (np.arange(count)[:, None] + 0.5) / count, 0.5)
        patches = tuple(
            Patch(self.mass_kg / count, float(x_0 + x), float(y_0 + y), float(side))
            for x, y in along * lengths
        )
        return replace(
            build,
            constraining_factor=times(build.constraining_factor, factor),
            lines_x_m=(*build.lines_x_m, x_0, x_1),
            lines_y_m=(*build.lines_y_m, y_0, y_1),
            patches=(*build.patches, *patches),
        )
