"""A base that does more than heave."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from instrument.campaign.beams.geometry import TrueBeam
from instrument.campaign.beams.hidden.base import HiddenInBeam, Setting, driven_by_base
from instrument.campaign.draws import either_sign, log_uniform
from instrument.campaign.plates.hidden.fixture import FixtureResonance


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
        return cls(either_sign(rng, 0.02, 0.08) / at.beam.length_m)

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
        low, high = at.resonances_hz[0] * 1.5, at.resonances_hz[-1] * 1.3
        pitch = either_sign(rng, 0.005, 0.03) / at.beam.length_m
        return cls(
            log_uniform(rng, low, high), log_uniform(rng, 0.01, 0.05), either_sign(rng, 0.01, 0.05), pitch
        )

    def reference(self, omega: Array) -> Complex:
        return np.asarray(1 / self.root(omega))
