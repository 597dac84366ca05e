"""A base that does more than heave."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from campaign.beams.geometry import TrueBeam
from campaign.beams.hidden.base import HiddenInBeam, Setting, driven_by_base
from campaign.draws import either_sign, log_uniform
from campaign.plates.hidden.fixture import FixtureResonance
from campaign.plates.hidden.sizes import FIXTURE_DAMPING, FIXTURE_FROM, FIXTURE_GAIN, FIXTURE_PITCH
from fitting.arrays import Array, Complex

_PITCH = (0.02, 0.08)
"""Times the length: what the far end moves by more than the root."""
_FIXTURE_TO = 1.3
"""Highest own frequency of a fixture over the last resonance: beyond it hardly anything is seen of it."""


@dataclass(frozen=True)
class HiddenBaseRocking(HiddenInBeam):
    """Pitch in proportion to the base's acceleration."""

    name: ClassVar[str] = "base_rocking"

    pitch_rad_m: float

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return driven_by_base(beam) and beam.whole

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenBaseRocking":
        return cls(either_sign(rng, *_PITCH) / at.beam.length_m)

    def pitch(self, omega: Array) -> Complex:
        return np.full(len(omega), self.pitch_rad_m, complex)


@dataclass(frozen=True)
class HiddenFixtureResonance(FixtureResonance, HiddenInBeam):
    """Near or beyond the resonances that are measured."""

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return driven_by_base(beam) and beam.whole

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenFixtureResonance":
        low, high = at.resonances_hz[0] * FIXTURE_FROM, at.resonances_hz[-1] * _FIXTURE_TO
        pitch = either_sign(rng, *FIXTURE_PITCH) / at.beam.length_m
        return cls(
            log_uniform(rng, low, high),
            log_uniform(rng, *FIXTURE_DAMPING),
            either_sign(rng, *FIXTURE_GAIN),
            pitch,
        )

    def reference(self, omega: Array) -> Complex:
        return np.asarray(1 / self.root(omega))
