"""A base that does more than heave, and a plate whose base is not where the reference channel sits."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from campaign.draws import either_sign, log_uniform
from campaign.plates.hidden.base import Hidden, Setting
from campaign.plates.hidden.fixture import FixtureResonance
from campaign.plates.hidden.sizes import FIXTURE_DAMPING, FIXTURE_FROM, FIXTURE_GAIN, FIXTURE_PITCH
from campaign.plates.response import BaseMotion
from fitting.arrays import Array, Complex

_PITCH, _ROLL = (0.01, 0.06), (0.08, 0.4)
"""Times length and width: what the far edge moves by more than the root. A roll shows less."""
_FIXTURE_TO = 1.6
"""Highest own frequency of a fixture over the last resonance: beyond it hardly anything is seen of it."""


@dataclass(frozen=True)
class HiddenBaseRocking(Hidden):
    """Pitch in proportion to the base's acceleration."""

    name: ClassVar[str] = "base_rocking"
    place: ClassVar[str] = "base"

    pitch_rad_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenBaseRocking":
        return cls(either_sign(rng, *_PITCH) / at.plate.length_m)

    def motion(self, motion: BaseMotion, omega: Array) -> BaseMotion:
        return BaseMotion(motion.pitch_rad_m + self.pitch_rad_m, motion.roll_rad_m)


@dataclass(frozen=True)
class HiddenBaseRoll(Hidden):
    """Roll about the plate's axis in proportion to the base's acceleration."""

    name: ClassVar[str] = "base_roll"
    place: ClassVar[str] = "base"

    roll_rad_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenBaseRoll":
        return cls(either_sign(rng, *_ROLL) / at.plate.width_m)

    def motion(self, motion: BaseMotion, omega: Array) -> BaseMotion:
        return BaseMotion(motion.pitch_rad_m, motion.roll_rad_m + self.roll_rad_m)


@dataclass(frozen=True)
class HiddenFixtureResonance(FixtureResonance, Hidden):
    """Near or beyond the resonances that are measured."""

    place: ClassVar[str] = "base"

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenFixtureResonance":
        low, high = at.resonances_hz[0] * FIXTURE_FROM, at.resonances_hz[2] * _FIXTURE_TO
        return cls(
            log_uniform(rng, low, high),
            log_uniform(rng, *FIXTURE_DAMPING),
            either_sign(rng, *FIXTURE_GAIN),
            either_sign(rng, *FIXTURE_PITCH) / at.plate.length_m,
        )

    def motion(self, motion: BaseMotion, omega: Array) -> BaseMotion:
        return BaseMotion(motion.pitch_rad_m + self.pitch(omega), motion.roll_rad_m)

    def reference(self, base: Complex, omega: Array) -> Complex:
        return np.asarray(base / self.root(omega))
