"""What sits on the beam, hangs on it or surrounds it; and a spot that is elsewhere."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.beams.geometry import TrueBeam
from campaign.beams.hidden.base import HiddenInBeam, Hung, Setting
from campaign.draws import either_sign, log_uniform
from campaign.plates.hidden.base import StillAir, felt_kg
from campaign.plates.hidden.sizes import (
    AIR_KG_M3,
    CABLE_LOSS,
    LOOSE_LOSS,
    LOOSE_MASS,
    LOOSE_NEAR,
    LOOSE_POWER,
    MASS,
)
from fitting.arrays import Array, Complex

_OF_BRIDGE = (0.3, 0.7)
"""Where a beam clamped at both ends moves most, of its span."""
_FROM_END = 0.02
"""Of the span: nothing hangs on the very end."""
_CABLE = (0.01, 0.05)
"""A cable's stiffness over what the first mode moves its tip against: a beam is light beside its cable."""
_ASIDE_M = (2e-3, 6e-3)
"""Of a spot: a laser pointed by hand, or measured from a wrong edge."""


def _place(rng: np.random.Generator, beam: TrueBeam, least: float) -> float:
    """Where a clamped beam moves, or anywhere on a free one."""
    low, high = _OF_BRIDGE if beam.ends == "clamped-clamped" else (least, 1 - _FROM_END)
    return beam.span_m * float(rng.uniform(low if beam.clamped else _FROM_END, high))


class _OnTheBeam(HiddenInBeam):
    """Something at one place of a beam of one piece."""

    x_m: float

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        return beam.whole

    def places_m(self) -> tuple[float, ...]:
        return (self.x_m,)


@dataclass(frozen=True)
class HiddenAddedMass(_OnTheBeam):
    """A point mass on the upper face, its own height left out."""

    name: ClassVar[str] = "added_mass"

    mass_kg: float
    x_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAddedMass":
        return cls(at.beam.mass_kg * log_uniform(rng, *MASS), _place(rng, at.beam, 0.5))

    def hung(self, omega: Array, pitch: Complex, force_driven: bool) -> tuple[Hung, ...]:
        force = -self.mass_kg * (1 + self.x_m * pitch)
        return (Hung(self.x_m, np.asarray(-self.mass_kg * omega**2, complex), force * (not force_driven)),)


@dataclass(frozen=True)
class HiddenTether(_OnTheBeam):
    """A cable: spring and dashpot from a point of the beam to the floor, or to what moves with the base."""

    name: ClassVar[str] = "tether"

    stiffness_n_m: float
    damping_ns_m: float
    x_m: float
    to_floor: bool

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenTether":
        omega = 2 * np.pi * at.resonances_hz[0]
        # A cantilever's first mode moves its tip as a quarter of its mass on a spring would.
        stiffness = at.beam.mass_kg / 4 * omega**2 * log_uniform(rng, *_CABLE)
        x = _place(rng, at.beam, 0.5)
        return cls(stiffness, stiffness * log_uniform(rng, *CABLE_LOSS) / omega, x, bool(rng.random() < 0.5))

    def hung(self, omega: Array, pitch: Complex, force_driven: bool) -> tuple[Hung, ...]:
        k = np.asarray(self.stiffness_n_m + 1j * omega * self.damping_ns_m)
        # The floor sees the base's displacement -a / w^2 of the point too.
        floor = self.to_floor and not force_driven
        return (Hung(self.x_m, k, k / omega**2 * (1 + self.x_m * pitch) if floor else 0 * k),)


@dataclass(frozen=True)
class HiddenLoosePart(_OnTheBeam):
    """A small mass on a spring of its own, its loss a power of frequency."""

    name: ClassVar[str] = "loose_part"

    mass_kg: float
    frequency_hz: float
    loss_factor: float
    """At that frequency."""
    x_m: float
    power: float
    """0: structural, 1: viscous."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenLoosePart":
        near = at.resonances_hz[int(rng.integers(len(at.resonances_hz)))] * (
            1 + either_sign(rng, *LOOSE_NEAR)
        )
        mass, loss = at.beam.mass_kg * log_uniform(rng, *LOOSE_MASS), log_uniform(rng, *LOOSE_LOSS)
        return cls(mass, near, loss, _place(rng, at.beam, 0.5), float(rng.uniform(*LOOSE_POWER)))

    def hung(self, omega: Array, pitch: Complex, force_driven: bool) -> tuple[Hung, ...]:
        felt = felt_kg(omega, self.mass_kg, self.frequency_hz, self.loss_factor, self.power)
        force = -felt * (1 + self.x_m * pitch)
        return (Hung(self.x_m, np.asarray(-felt * omega**2), force * (not force_driven)),)


@dataclass(frozen=True)
class HiddenAirAddedMass(StillAir, HiddenInBeam):
    """Still air about the beam."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAirAddedMass":
        return cls(float(rng.uniform(*AIR_KG_M3)))


@dataclass(frozen=True)
class HiddenSpotOffset(HiddenInBeam):
    """The laser's spot is beside the stated place."""

    name: ClassVar[str] = "spot_offset"

    dx_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenSpotOffset":
        dx = either_sign(rng, *_ASIDE_M)
        inside = 0 < at.beam.spot_m + dx < at.beam.span_m
        return cls(dx if inside else -dx)

    def beam(self, true: TrueBeam) -> TrueBeam:
        return replace(true, spot_m=true.spot_m + self.dx_m)
