"""What goes wrong where a plate is struck: points, blows, channels of one spot, what it hangs or lies on."""

# ruff: noqa: D102 -- the hooks are described in base.py

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from campaign.draws import either_sign, log_uniform
from campaign.plates.blows import Blows
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden import HIDDEN
from campaign.plates.hidden.attached import HiddenTether, plate_mass_kg
from campaign.plates.hidden.base import Attachment, Hidden, Setting
from campaign.plates.hidden.sizes import CABLE_LOSS
from campaign.plates.response import BaseMotion
from fitting.arrays import Array, Complex

Place = tuple[float, float]

PLACES: tuple[Place, ...] = (
    (0.03, 0.05),
    (0.95, 0.08),
    (0.97, 0.93),
    (0.31, 0.96),
    (0.62, 0.03),
    (0.46, 0.36),
    (0.22, 0.58),
    (0.76, 0.71),
)
"""Of length and width: where a plate may be struck, read or held."""

_CABLE_N_M = (150.0, 1500.0)
"""Thin coaxial cables to thick ones, taped down a hand's width away."""
_ON_PADS = (0.12, 0.3)
"""Of the first resonance: where a plate bounces on pads that are not soft. A tenth is the rule."""

_FOAM = (0.1, 0.4)
"""Loss factor of pads."""
_ASIDE_M, _EVERY_SPOT = (4e-3, 7e-3), 0.3
"""From where a point should be, several tolerances; share of wrong corners that are wrong for all spots."""
_GAIN = (0.04, 0.1)
"""Of a mistyped sensitivity: beyond what a hammer's is known to."""
_BOUNCE, _BOUNCE_S = (0.1, 0.5), (4e-3, 4e-2)
"""Of a second blow: its size over the first one's, and how much later."""
_RECORD_S, _WEIGHTED_TO = (0.8, 2.0), (1e-3, 5e-2)
"""Length of records that are weighted by an exponential window, and what is left at their ends."""


@dataclass(frozen=True)
class HiddenOfBlows(Hidden):
    """An effect of the measurement: where blows land, where they are read, and what becomes of them."""

    def of_force(self, force_m: Place) -> Place:
        """Where the hammer is really aimed."""
        return force_m

    def of_spot(self, number: int, spot_m: Place) -> Place:
        """Where a spot really is, counted from 0."""
        return spot_m

    def of_reading(self, number: int, mobility: Complex) -> Complex:
        """What the channels make of it at a spot. Shape (..., lines)."""
        return mobility

    def of_blows(self, blows: Blows) -> Blows:
        """How it is really struck."""
        return blows

    def weighted(self) -> tuple[float, int]:
        """By how much every decay is quickened, 1/s; how often what is read is integrated to a velocity."""
        return 0.0, 0


def _aside(rng: np.random.Generator) -> Place:
    size, angle = float(rng.uniform(*_ASIDE_M)), float(rng.uniform(-np.pi, np.pi))
    return size * float(np.cos(angle)), size * float(np.sin(angle))


@dataclass(frozen=True)
class HiddenSpotElsewhere(HiddenOfBlows):
    """One spot is measured from a wrong corner, or all of them are."""

    name: ClassVar[str] = "spot_offset"
    place: ClassVar[str] = "spot"

    dx_m: float
    dy_m: float
    every: bool

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenSpotElsewhere":
        return cls(*_aside(rng), every=bool(rng.random() < _EVERY_SPOT))

    def of_spot(self, number: int, spot_m: Place) -> Place:
        return (spot_m[0] + self.dx_m, spot_m[1] + self.dy_m) if self.every or not number else spot_m


@dataclass(frozen=True)
class HiddenHitElsewhere(HiddenOfBlows):
    """The point of the blows is measured from a wrong corner: as far off as a spot would be."""

    name: ClassVar[str] = "hit_elsewhere"
    place: ClassVar[str] = "spot"
    in_catalogue: ClassVar[bool] = False

    dx_m: float
    dy_m: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenHitElsewhere":
        return cls(*_aside(rng))

    def of_force(self, force_m: Place) -> Place:
        return force_m[0] + self.dx_m, force_m[1] + self.dy_m


@dataclass(frozen=True)
class HiddenGainOfASpot(HiddenOfBlows):
    """The sensitivity of the hammer, or of the velocity, was mistyped for one of the spots."""

    name: ClassVar[str] = "gain_of_a_spot"
    place: ClassVar[str] = "velocity channel"
    near: ClassVar[tuple[str, ...]] = ("gain_error",)

    factor: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenGainOfASpot":
        return cls(1 + either_sign(rng, *_GAIN))

    def of_reading(self, number: int, mobility: Complex) -> Complex:
        return mobility if number else mobility * self.factor


@dataclass(frozen=True)
class HiddenDoubleHit(HiddenOfBlows):
    """One blow of the mean is two, and the force's window has cut off the second."""

    name: ClassVar[str] = "double_hit"
    place: ClassVar[str] = "force channel"
    in_catalogue: ClassVar[bool] = False

    size: float
    """Over the first one's."""
    late_s: float

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenDoubleHit":
        return cls(log_uniform(rng, *_BOUNCE), log_uniform(rng, *_BOUNCE_S))

    def of_blows(self, blows: Blows) -> Blows:
        others = blows.bounce[1:], blows.late_s[1:]
        return replace(blows, bounce=(self.size, *others[0]), late_s=(self.late_s, *others[1]))


@dataclass(frozen=True)
class HiddenExponentialWindow(HiddenOfBlows):
    """Every record was weighted by exp(-t / tau), which the analyser offers where a blow rings on."""

    name: ClassVar[str] = "exponential_window"
    place: ClassVar[str] = "velocity channel"

    tau_s: float
    integrations: int
    """Of what is read, to a velocity."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenExponentialWindow":
        return cls(
            float(rng.uniform(*_RECORD_S)) / -np.log(log_uniform(rng, *_WEIGHTED_TO)), int(rng.integers(2))
        )

    def weighted(self) -> tuple[float, int]:
        return 1 / self.tau_s, self.integrations


@dataclass(frozen=True)
class HiddenCable(HiddenTether):
    """A cable from one of the points, but the one by the root, to a table."""

    changes_solid: ClassVar[bool] = False

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenCable":
        k, (x, y) = log_uniform(rng, *_CABLE_N_M), PLACES[int(rng.integers(1, len(PLACES)))]
        damping = k * log_uniform(rng, *CABLE_LOSS) / (2 * np.pi * at.resonances_hz[0])
        return cls(k, damping, x * at.plate.length_m, y * at.plate.width_m, to_floor=True)


@dataclass(frozen=True)
class HiddenPads(Hidden):
    """Four pads of foam, by three corners and an edge, hold a plate that is meant to be free."""

    name: ClassVar[str] = "pads"
    place: ClassVar[str] = "cable"
    in_catalogue: ClassVar[bool] = False

    stiffness_n_m: float
    """Of each."""
    loss_factor: float
    corners_m: tuple[Place, ...]

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenPads":
        bounces = 2 * np.pi * at.resonances_hz[0] * float(rng.uniform(*_ON_PADS))
        stiffness = float(plate_mass_kg(at.plate) * bounces**2 / 4)
        corners = tuple((x * at.plate.length_m, y * at.plate.width_m) for x, y in PLACES[:4])
        return cls(stiffness, float(rng.uniform(*_FOAM)), corners)

    def points(self) -> tuple[Place, ...]:
        return self.corners_m

    def attached(self, omega: Array, motion: BaseMotion, width_m: float) -> tuple[Attachment, ...]:
        k = np.full(len(omega), self.stiffness_n_m * (1 + 1j * self.loss_factor))
        return tuple(Attachment(x, y, k, 0 * k) for x, y in self.corners_m)


NONE = "none"
OF_CLAMPED = (
    "clamp_compliance",
    "uneven_clamp",
    "clamp_line",
    "treatment_not_gripped",
    "viscous_damping",
)
"""Kinds that are hidden in clamped plates alone."""
OF_FREE = (HiddenPads.name,)
"""The same of free ones."""
_OF_BOTH = (
    "added_mass",
    "added_masses",
    "loose_part",
    "air_added_mass",
    "core_thickness",
    "constraining_stiffness",
    "constraining_thickness",
    "substrate_stiffness",
    "orthotropic_substrate",
    "graded_core",
    "partial_debond",
    "channel_delay",
    "gain_error",
    "sensor_lowpass",
    "ac_coupling",
    "cracked_substrate",
    "wrinkled_constraining",
)
_OWN: tuple[type[Hidden], ...] = (
    HiddenCable,
    HiddenSpotElsewhere,
    HiddenGainOfASpot,
    HiddenHitElsewhere,
    HiddenDoubleHit,
    HiddenExponentialWindow,
    HiddenPads,
)
_EFFECTS = {name: HIDDEN[name] for name in (*_OF_BOTH, *OF_CLAMPED)} | {h.name: h for h in _OWN}
STRUCK_KINDS = (NONE, *_EFFECTS)
"""What may be hidden where a plate is struck: nothing, or one effect."""


def draw_hidden_in_struck(
    kind: str, rng: np.random.Generator, true: TruePlate, resonances_hz: tuple[float, ...]
) -> tuple[Hidden, ...]:
    """The effect of a kind; nothing for `NONE`."""
    return () if kind == NONE else (_EFFECTS[kind].draw(rng, Setting(true, resonances_hz, 0.0)),)
