"""What sits on the plate, hangs on it or surrounds it."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.draws import either_sign, log_uniform
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.base import (
    Attachment,
    Hidden,
    Setting,
    StillAir,
    felt_kg,
)
from campaign.plates.hidden.sizes import (
    AIR_KG_M3,
    CABLE_LOSS,
    LOOSE_LOSS,
    LOOSE_MASS,
    LOOSE_NEAR,
    LOOSE_POWER,
    MASS,
)
from campaign.plates.response import BaseMotion
from campaign.plates.solid import Build, Patch
from fitting.arrays import Array

_SIDE_M = (0.006, 0.014)
"""Of the square that a mass covers: a small accelerometer's foot."""
_APART = 0.3
"""Of the length, between two masses: nearer ones are as good as one."""
_CABLE = (0.005, 0.04)
"""A cable's stiffness over what the first mode moves its tip against."""


def plate_mass_kg(true: TruePlate) -> float:
    """Mass of all layers of a plate."""
    layers = (true.substrate, true.core, true.constraining)
    return (
        true.length_m * true.width_m * sum(k.thickness_m * k.density_kg_m3 for k in layers if k is not None)
    )


def _patch(rng: np.random.Generator, true: TruePlate, least: float) -> tuple[float, float, float, float]:
    """Mass, x, y, side."""
    side = float(rng.uniform(*_SIDE_M))
    x = float(rng.uniform(least * true.length_m, true.length_m - side / 2))
    y = float(rng.uniform(side / 2, true.width_m - side / 2))
    return plate_mass_kg(true) * log_uniform(rng, *MASS), x, y, side


@dataclass(frozen=True)
class HiddenAddedMass(Hidden):
    """A mass of a size of its own on the constraining layer, its own height left out."""

    name: ClassVar[str] = "added_mass"
    place: ClassVar[str] = "mass"
    changes_solid: ClassVar[bool] = True

    mass_kg: float
    x_m: float
    y_m: float
    side_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAddedMass":
        return cls(*_patch(rng, at.plate, 0.5))

    def build(self, build: Build, true: TruePlate) -> Build:
        patch = Patch(self.mass_kg, self.x_m, self.y_m, self.side_m)
        return replace(build, patches=(*build.patches, patch))


@dataclass(frozen=True)
class HiddenAddedMasses(Hidden):
    """Two such masses apart from each other."""

    name: ClassVar[str] = "added_masses"
    place: ClassVar[str] = "mass"
    changes_solid: ClassVar[bool] = True

    first_kg: float
    first_x_m: float
    first_y_m: float
    second_kg: float
    second_x_m: float
    second_y_m: float
    side_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAddedMasses":
        while True:
            first, second = _patch(rng, at.plate, 0.4), _patch(rng, at.plate, 0.4)
            if np.hypot(first[1] - second[1], first[2] - second[2]) > _APART * at.plate.length_m:
                return cls(*first[:3], *second[:3], first[3])

    def build(self, build: Build, true: TruePlate) -> Build:
        first = Patch(self.first_kg, self.first_x_m, self.first_y_m, self.side_m)
        second = Patch(self.second_kg, self.second_x_m, self.second_y_m, self.side_m)
        return replace(build, patches=(*build.patches, first, second))


@dataclass(frozen=True)
class HiddenAirAddedMass(StillAir, Hidden):
    """Still air about the plate, a mass of the solid."""

    place: ClassVar[str] = "air"
    changes_solid: ClassVar[bool] = True

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenAirAddedMass":
        return cls(float(rng.uniform(*AIR_KG_M3)))


@dataclass(frozen=True)
class HiddenTether(Hidden):
    """A cable: spring and dashpot from a point of the plate to the floor, or to what moves with the base."""

    name: ClassVar[str] = "tether"
    place: ClassVar[str] = "cable"
    changes_solid: ClassVar[bool] = True

    stiffness_n_m: float
    damping_ns_m: float
    x_m: float
    y_m: float
    to_floor: bool

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenTether":
        true = at.plate
        # A cantilever's first mode moves its tip as a quarter of its mass on a spring would.
        tip = plate_mass_kg(true) / 4 * (2 * np.pi * at.resonances_hz[0]) ** 2
        stiffness = tip * log_uniform(rng, *_CABLE)
        # Loss factor of the cable at the first resonance.
        damping = stiffness * log_uniform(rng, *CABLE_LOSS) / (2 * np.pi * at.resonances_hz[0])
        x, y = true.length_m * rng.uniform(0.5, 0.98), true.width_m * rng.uniform(0.05, 0.95)
        return cls(stiffness, damping, float(x), float(y), bool(rng.random() < 0.5))

    def points(self) -> tuple[tuple[float, float], ...]:
        return ((self.x_m, self.y_m),)

    def attached(self, omega: Array, motion: BaseMotion, width_m: float) -> tuple[Attachment, ...]:
        k = np.asarray(self.stiffness_n_m + 1j * omega * self.damping_ns_m)
        # The floor sees the base's displacement -a / w^2 of the point too.
        force = k / omega**2 * motion.at(self.x_m, self.y_m, width_m) if self.to_floor else 0 * k
        return (Attachment(self.x_m, self.y_m, k, np.asarray(force)),)


@dataclass(frozen=True)
class HiddenLoosePart(Hidden):
    """A small mass on a spring of its own, its loss a power of frequency: a clip, a liquid that sloshes."""

    name: ClassVar[str] = "loose_part"
    place: ClassVar[str] = "part"
    changes_solid: ClassVar[bool] = True

    mass_kg: float
    frequency_hz: float
    loss_factor: float
    """At that frequency."""
    x_m: float
    y_m: float
    power: float
    """0: structural, 1: viscous."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenLoosePart":
        true = at.plate
        x, y = true.length_m * rng.uniform(0.5, 0.95), true.width_m * rng.uniform(0.1, 0.9)
        near = at.resonances_hz[int(rng.integers(3))] * (1 + either_sign(rng, *LOOSE_NEAR))
        mass = plate_mass_kg(true) * log_uniform(rng, *LOOSE_MASS)
        loss = log_uniform(rng, *LOOSE_LOSS)
        return cls(mass, near, loss, float(x), float(y), float(rng.uniform(*LOOSE_POWER)))

    def points(self) -> tuple[tuple[float, float], ...]:
        return ((self.x_m, self.y_m),)

    def attached(self, omega: Array, motion: BaseMotion, width_m: float) -> tuple[Attachment, ...]:
        felt = felt_kg(omega, self.mass_kg, self.frequency_hz, self.loss_factor, self.power)
        force = -felt * motion.at(self.x_m, self.y_m, width_m)
        return (Attachment(self.x_m, self.y_m, np.asarray(-(omega**2) * felt), np.asarray(force)),)


@dataclass(frozen=True)
class HiddenTipMagnet(Hidden):
    """A magnet near the free end: it pulls the more, the nearer the plate comes. A negative spring."""

    name: ClassVar[str] = "tip_magnet"
    place: ClassVar[str] = "strange"
    near: ClassVar[tuple[str, ...]] = ("tether",)
    in_catalogue: ClassVar[bool] = False
    changes_solid: ClassVar[bool] = True

    stiffness_n_m: float
    x_m: float
    y_m: float
    to_floor: bool

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenTipMagnet":
        tether = HiddenTether.draw(rng, at)
        return cls(
            -tether.stiffness_n_m,
            0.98 * at.plate.length_m,
            at.plate.width_m * float(rng.uniform(0.3, 0.7)),
            tether.to_floor,
        )

    def points(self) -> tuple[tuple[float, float], ...]:
        return ((self.x_m, self.y_m),)

    def attached(self, omega: Array, motion: BaseMotion, width_m: float) -> tuple[Attachment, ...]:
        pull = HiddenTether(self.stiffness_n_m, 0.0, self.x_m, self.y_m, self.to_floor)
        return pull.attached(omega, motion, width_m)
