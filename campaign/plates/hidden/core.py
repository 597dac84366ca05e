"""A core that is not the same everywhere, or not the same all the time."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.draws import either_sign
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.base import (
    Hidden,
    Setting,
    Softening,
    draw_softening,
    times,
)
from campaign.plates.hidden.room import RoomCycles, RoomStep, arrhenius, draw_cycles, draw_step
from campaign.plates.hidden.sizes import (
    ACTIVATION_J_MOL,
    BOND_EDGE,
    COOLS,
    DEBONDED,
    DRIFT_K,
    DRIFT_TIME,
    LOOSENED,
)
from campaign.plates.solid import Build, Field
from fitting.arrays import Array

_GRADED = (0.2, 0.4)
"""Slope of a core's modulus from one end to the other, over its mean."""
_GRADIENT = (0.1, 0.6)
"""Of a drift, between both ends: the clamp is a sink, or a source, of heat."""


@dataclass(frozen=True)
class HiddenGradedCore(Hidden):
    """The modulus grows along x or y."""

    name: ClassVar[str] = "graded_core"
    place: ClassVar[str] = "core"
    changes_solid: ClassVar[bool] = True

    along: str
    slope: float
    """From one end to the other, over the mean."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenGradedCore":
        return cls(str(rng.choice(["x", "y"])), either_sign(rng, *_GRADED))

    def build(self, build: Build, true: TruePlate) -> Build:
        def factor(x: Array, y: Array) -> Array:
            share = x / true.length_m if self.along == "x" else y / true.width_m
            return np.asarray(1 + self.slope * (share - 0.5))

        return replace(build, core_factor=times(build.core_factor, factor))


@dataclass(frozen=True)
class HiddenPartialDebond(Hidden):
    """A strip has come loose; towards its edges the bond is gradually better."""

    name: ClassVar[str] = "partial_debond"
    place: ClassVar[str] = "core"
    changes_solid: ClassVar[bool] = True

    along: str
    """"x": all of the width between two x; "y": all of the length between two y."""
    from_m: float
    to_m: float
    edge_m: float
    """Over which the bond recovers."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenPartialDebond":
        along = str(rng.choice(["x", "y"]))
        side = at.plate.length_m if along == "x" else at.plate.width_m
        wide = side * float(rng.uniform(*DEBONDED))
        begin = float(rng.uniform(0, side - wide))
        if along == "y":
            # Where it comes loose along the length it begins at an edge.
            begin = 0.0 if rng.random() < 0.5 else side - wide
        return cls(along, begin, begin + wide, side * float(rng.uniform(*BOND_EDGE)))

    def build(self, build: Build, true: TruePlate) -> Build:
        def factor(x: Array, y: Array) -> Array:
            at = x if self.along == "x" else y
            side = true.length_m if self.along == "x" else true.width_m
            low = -1.0 if self.from_m <= 0 else self.from_m
            high = side + 1.0 if self.to_m >= side * (1 - 1e-9) else self.to_m
            into = (np.tanh((at - low) / self.edge_m) - np.tanh((at - high) / self.edge_m)) / 2
            return np.asarray(1 - LOOSENED * into)

        changed = replace(build, core_factor=times(build.core_factor, factor))
        ends = tuple(e + d for e in (self.from_m, self.to_m) for d in (-self.edge_m, self.edge_m))
        if self.along == "x":
            return replace(changed, lines_x_m=(*build.lines_x_m, *ends))
        return replace(changed, lines_y_m=(*build.lines_y_m, *ends))


@dataclass(frozen=True)
class HiddenTemperatureDrift(Hidden):
    """The core warms, more at one end than at the other; its times shift as Arrhenius has it."""

    name: ClassVar[str] = "temperature_drift"
    place: ClassVar[str] = "core"
    groups: ClassVar[str] = "columns"
    changes_solid: ClassVar[bool] = True

    kelvin: float
    """In the end, at the middle of the plate."""
    time_constant_s: float
    gradient: float
    """Difference of both ends over that of the middle; positive: the clamp is warmer."""
    activation_j_mol: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenTemperatureDrift":
        sign = -1.0 if rng.random() < COOLS else 1.0
        return cls(
            sign * float(rng.uniform(*DRIFT_K)),
            at.duration_s * float(rng.uniform(*DRIFT_TIME)),
            either_sign(rng, *_GRADIENT),
            float(rng.uniform(*ACTIVATION_J_MOL)),
        )

    def stirred(self, true: TruePlate) -> tuple[Field, ...]:
        return (lambda x, y: x / true.length_m + 0 * y,)

    def frequency_factor(self, time_s: Array, x: Array, length_m: float) -> Array | None:
        share = 1 + self.gradient * (0.5 - x / length_m)
        kelvin = -self.kelvin * np.expm1(-time_s / self.time_constant_s)[:, None] * share
        return arrhenius(kelvin, self.activation_j_mol)


@dataclass(frozen=True)
class HiddenRoomCycles(RoomCycles, Hidden):
    """All of the core follows the room."""

    place: ClassVar[str] = "core"

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenRoomCycles":
        return cls(*draw_cycles(rng, at.duration_s))

    def frequency_factor(self, time_s: Array, x: Array, length_m: float) -> Array | None:
        return arrhenius(self.kelvin(time_s)[:, None] + 0 * x, self.activation_j_mol)


@dataclass(frozen=True)
class HiddenRoomStep(RoomStep, Hidden):
    """All of the core is as warm as the room."""

    place: ClassVar[str] = "core"

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenRoomStep":
        return cls(*draw_step(rng, at.duration_s, len(at.resonances_hz)))

    def frequency_factor(self, time_s: Array, x: Array, length_m: float) -> Array | None:
        return self.warmed(time_s)[:, None] + 0 * x


@dataclass(frozen=True)
class HiddenAmplitudeSoftening(Softening, Hidden):
    """Each brick softens with its own strain."""

    name: ClassVar[str] = "amplitude_softening"
    place: ClassVar[str] = "core"
    groups: ClassVar[str] = "bricks"
    changes_solid: ClassVar[bool] = True

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAmplitudeSoftening":
        return cls(*draw_softening(rng))

    def stirred(self, true: TruePlate) -> tuple[Field, ...]:
        # Strain of the first mode is largest near the clamp, of the others in several places.
        return tuple(lambda x, y, n=n: np.cos(n * np.pi * x / true.length_m) + 0 * y for n in (1, 2))
