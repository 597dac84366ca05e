"""A base that does more than heave."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from instrument.campaign.beams.geometry import TrueBeam
from instrument.campaign.beams.hidden.base import HiddenInBeam, Setting, driven_by_base
from instrument.campaign.draws import either_sign, log_uniform


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
class HiddenFixtureResonance(HiddenInBeam):
    """The fixture yields between reference sensor and root, and it pitches.

    The root moves by 1 + gain r^2/(1 - r^2) of the reference, r the frequency over that of the fixture.
    """

    name: ClassVar[str] = "fixture_resonance"
    near: ClassVar[tuple[str, ...]] = ("base_rocking",)

    frequency_hz: float
    damping_ratio: float
    gain: float
    pitch_rad_m: float
    """Per acceleration of the reference, times the same r^2/(1 - r^2)."""

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

    def _swing(self, omega: Array) -> Complex:
        r = omega / (2 * np.pi * self.frequency_hz)
        return np.asarray(r**2 / (1 - r**2 + 2j * self.damping_ratio * r))

    def pitch(self, omega: Array) -> Complex:
        return np.asarray(self.pitch_rad_m * self._swing(omega) / (1 + self.gain * self._swing(omega)))

    def reference(self, omega: Array) -> Complex:
        return np.asarray(1 / (1 + self.gain * self._swing(omega)))
