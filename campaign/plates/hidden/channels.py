"""What the laser looks at and what its channel makes of it, and damping that the hammer did not see."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from campaign.draws import either_sign, log_uniform
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.base import Hidden, Setting
from fitting.arrays import Array, Complex

_ASIDE_M = (2e-3, 6e-3)
"""Of a spot: a laser pointed by hand, or measured from a wrong edge."""
_LATE_S = (30e-6, 150e-6)
"""Ten tolerances of a delay and more: what a decoder takes."""
_GAIN = (0.015, 0.04)
"""Five tolerances of a gain and more."""
_LOWPASS_HZ, _AC_HZ = (1e3, 5e3), (0.3, 2.0)
"""Corners of filters beyond either end of what is swept, which reach into it."""
_DEGREES = (1.02, 1.05)
"""What a phase meter shows over what it should."""
_MORE_DAMPING = (1.5, 3.0)
"""Of the treated plate over the bare one: edges, cables and glue."""


@dataclass(frozen=True)
class HiddenSpotOffset(Hidden):
    """The laser's spot is beside the stated place."""

    name: ClassVar[str] = "spot_offset"
    place: ClassVar[str] = "spot"

    dx_m: float
    dy_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenSpotOffset":
        size, angle = float(rng.uniform(*_ASIDE_M)), float(rng.uniform(-np.pi / 3, np.pi / 3))
        return cls(float(rng.choice([-1, 1])) * size * float(np.cos(angle)), size * float(np.sin(angle)))

    def spot(self, spot_m: tuple[float, float], true: TruePlate) -> tuple[float, float]:
        x, y = spot_m[0] + self.dx_m, spot_m[1] + self.dy_m
        return min(max(x, 0.0), true.length_m), min(max(y, 0.0), true.width_m)


@dataclass(frozen=True)
class HiddenAbsoluteVelocity(Hidden):
    """The laser stands on the floor and reads the base too."""

    name: ClassVar[str] = "absolute_velocity"
    place: ClassVar[str] = "velocity channel"

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAbsoluteVelocity":
        return cls()

    def channel(self, velocity_s: Complex, omega: Array, base_s: Complex) -> Complex:
        return velocity_s + base_s


@dataclass(frozen=True)
class HiddenChannelDelay(Hidden):
    """The velocity channel is late by a constant time."""

    name: ClassVar[str] = "channel_delay"
    place: ClassVar[str] = "velocity channel"

    delay_s: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenChannelDelay":
        return cls(float(rng.uniform(*_LATE_S)))

    def channel(self, velocity_s: Complex, omega: Array, base_s: Complex) -> Complex:
        return np.asarray(velocity_s * np.exp(-1j * omega * self.delay_s))


@dataclass(frozen=True)
class HiddenGainError(Hidden):
    """The velocity channel's scale is off by a factor."""

    name: ClassVar[str] = "gain_error"
    place: ClassVar[str] = "velocity channel"

    factor: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenGainError":
        return cls(1 + either_sign(rng, *_GAIN))

    def channel(self, velocity_s: Complex, omega: Array, base_s: Complex) -> Complex:
        return velocity_s * self.factor


@dataclass(frozen=True)
class HiddenSensorLowpass(Hidden):
    """A first-order filter in the velocity channel."""

    name: ClassVar[str] = "sensor_lowpass"
    place: ClassVar[str] = "velocity channel"

    corner_hz: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenSensorLowpass":
        return cls(log_uniform(rng, *_LOWPASS_HZ))

    def channel(self, velocity_s: Complex, omega: Array, base_s: Complex) -> Complex:
        return np.asarray(velocity_s / (1 + 1j * omega / (2 * np.pi * self.corner_hz)))


@dataclass(frozen=True)
class HiddenAcCoupling(Hidden):
    """The velocity channel has lost its constant part, and some of what is slow."""

    name: ClassVar[str] = "ac_coupling"
    place: ClassVar[str] = "velocity channel"

    corner_hz: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAcCoupling":
        return cls(log_uniform(rng, *_AC_HZ))

    def channel(self, velocity_s: Complex, omega: Array, base_s: Complex) -> Complex:
        return np.asarray(velocity_s / (1 + 2 * np.pi * self.corner_hz / (1j * omega)))


@dataclass(frozen=True)
class HiddenPhaseScale(Hidden):
    """A phase meter that counts from 0 to 360 degrees shows a few per cent too many of them."""

    name: ClassVar[str] = "phase_scale"
    place: ClassVar[str] = "velocity channel"

    factor: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenPhaseScale":
        return cls(float(rng.uniform(*_DEGREES)))

    def channel(self, velocity_s: Complex, omega: Array, base_s: Complex) -> Complex:
        phase = np.angle(velocity_s) % (2 * np.pi)
        return np.asarray(np.abs(velocity_s) * np.exp(1j * self.factor * phase))


@dataclass(frozen=True)
class HiddenViscousDamping(Hidden):
    """The treated plate's remaining damping is not the bare plate's."""

    name: ClassVar[str] = "viscous_damping"
    place: ClassVar[str] = "remaining damping"

    scale: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenViscousDamping":
        return cls(float(rng.uniform(*_MORE_DAMPING)))

    def ratios(self, ratios: Array) -> Array:
        return ratios * self.scale
