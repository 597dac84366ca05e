"""A core that is not the same everywhere, or not the same all the time."""

# ruff: noqa: D102 -- the hooks are described in base.py

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.beams.geometry import TrueBeam
from campaign.beams.hidden.base import HiddenInBeam, Setting
from campaign.draws import either_sign
from campaign.plates.hidden.base import Softening, draw_softening
from campaign.plates.hidden.room import RoomCycles, RoomStep, arrhenius, draw_cycles, draw_step
from campaign.plates.hidden.sizes import (
    ACTIVATION_J_MOL,
    BOND_EDGE,
    COOLS,
    DEBONDED,
    DRIFT_K,
    DRIFT_TIME,
)
from drivers.simulated.plant.solid_beam import BeamBuild
from fitting.arrays import Array

_GRADED = (0.25, 0.6)
"""Slope of a core's modulus from one end to the other, over its mean: a beam shows less of it."""
_AT_CLAMP, _LEFT = 0.6, (0.01, 0.05)
"""Share of loose strips that are at the clamp, where it shows most; what is left of the stiffness within."""


def _times(build: BeamBuild, factor: Callable[[Array], Array]) -> BeamBuild:
    own = build.core_factor
    return replace(build, core_factor=factor if own is None else lambda x: own(x) * factor(x))


@dataclass(frozen=True)
class HiddenGradedCore(HiddenInBeam):
    """The modulus grows along the beam."""

    name: ClassVar[str] = "graded_core"

    slope: float
    """From one end to the other, over the mean."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenGradedCore":
        return cls(either_sign(rng, *_GRADED))

    def build(self, build: BeamBuild, true: TrueBeam) -> BeamBuild:
        return _times(build, lambda x: 1 + self.slope * (x / true.span_m - 0.5))


@dataclass(frozen=True)
class HiddenPartialDebond(HiddenInBeam):
    """A strip at an end has come loose; towards its edge the bond is gradually better."""

    name: ClassVar[str] = "partial_debond"

    from_m: float
    to_m: float
    edge_m: float
    """Over which the bond recovers."""
    left: float
    """Of the stiffness, within."""

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return beam.constraining is not None

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenPartialDebond":
        span = at.beam.span_m
        wide = span * float(rng.uniform(*DEBONDED))
        # At the free end most of it slips freely as it is: what comes loose there shows little.
        begin = 0.0 if rng.random() < _AT_CLAMP else span - wide
        return cls(begin, begin + wide, span * float(rng.uniform(*BOND_EDGE)), float(rng.uniform(*_LEFT)))

    def build(self, build: BeamBuild, true: TrueBeam) -> BeamBuild:
        low = -1.0 if self.from_m <= 0 else self.from_m
        high = true.span_m + 1.0 if self.to_m >= true.span_m * (1 - 1e-9) else self.to_m

        def factor(x: Array) -> Array:
            into = (np.tanh((x - low) / self.edge_m) - np.tanh((x - high) / self.edge_m)) / 2
            return np.asarray(1 - (1 - self.left) * into)

        ends = tuple(e + d for e in (self.from_m, self.to_m) for d in (-self.edge_m, self.edge_m))
        return _times(replace(build, lines_x_m=(*build.lines_x_m, *ends)), factor)


@dataclass(frozen=True)
class HiddenTemperatureDrift(HiddenInBeam):
    """The core warms; its times shift as Arrhenius has it."""

    name: ClassVar[str] = "temperature_drift"

    kelvin: float
    """In the end."""
    time_constant_s: float
    activation_j_mol: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenTemperatureDrift":
        sign = -1.0 if rng.random() < COOLS else 1.0
        time = at.duration_s * float(rng.uniform(*DRIFT_TIME))
        return cls(sign * float(rng.uniform(*DRIFT_K)), time, float(rng.uniform(*ACTIVATION_J_MOL)))

    def frequency_factor(self, time_s: Array) -> Array | None:
        kelvin = -self.kelvin * np.expm1(-time_s / self.time_constant_s)
        return arrhenius(kelvin, self.activation_j_mol)


@dataclass(frozen=True)
class HiddenRoomCycles(RoomCycles, HiddenInBeam):
    """All of the core follows the room."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenRoomCycles":
        return cls(*draw_cycles(rng, at.duration_s))

    def frequency_factor(self, time_s: Array) -> Array | None:
        return arrhenius(self.kelvin(time_s), self.activation_j_mol)


@dataclass(frozen=True)
class HiddenRoomStep(RoomStep, HiddenInBeam):
    """All of the core is as warm as the room."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenRoomStep":
        return cls(*draw_step(rng, at.duration_s, len(at.resonances_hz)))

    def frequency_factor(self, time_s: Array) -> Array | None:
        return self.warmed(time_s)


@dataclass(frozen=True)
class HiddenAmplitudeSoftening(Softening, HiddenInBeam):
    """Each strip of the core softens with its own strain."""

    name: ClassVar[str] = "amplitude_softening"
    strips: ClassVar[int] = 8

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return beam.constraining is not None

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAmplitudeSoftening":
        return cls(*draw_softening(rng))
