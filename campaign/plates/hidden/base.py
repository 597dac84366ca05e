"""What every hidden effect is: where it may reach into the plate, the base, the channels. By default nowhere.

What reaches into the plate shares no formula with the catalogue of the diagnosis: it is a part of a solid. A
delay or a gain of a channel is the same in both.
"""

from dataclasses import asdict, dataclass
from typing import Any, ClassVar

import numpy as np

from campaign.draws import log_uniform
from campaign.plates.geometry import TruePlate
from campaign.plates.response import BaseMotion
from campaign.plates.solid import Build, Field
from campaign.schedule import Schedule
from fitting.arrays import Array, Complex

_LOST, _MOST_LOST = (0.05, 0.2), (0.4, 0.7)
"""Of the modulus, at the reference strain, and at all: a filled rubber's over the strains of a sweep."""
_POWER, _BEND = (0.8, 1.3), (0.4, 0.9)
"""About Kraus' exponents, one and a half."""
_RUBBING = (0.0, 0.25)
"""Loss gained, over what can be lost: none to what carbon black does."""


def times(first: Field | None, second: Field) -> Field:
    """The product of two factors over the plate."""
    return second if first is None else lambda x, y: first(x, y) * second(x, y)


def felt_kg(omega: Array, mass_kg: float, own_hz: float, loss_factor: float, power: float) -> Complex:
    """What a mass on a spring of its own is felt as. Its loss, told at its own frequency, goes with a power.

    Shape of `omega`, in rad/s.
    """
    own = 2 * np.pi * own_hz
    k = np.asarray(own**2 * (1 + 1j * loss_factor * (omega / own) ** power))
    return np.asarray(mass_kg * k / (k - omega**2))


def draw_softening(rng: np.random.Generator) -> tuple[float, float, float, float, float]:
    """Numbers of `Softening`, as filled rubbers have them."""
    lost = log_uniform(rng, *_LOST), float(rng.uniform(*_MOST_LOST)), float(rng.uniform(*_POWER))
    return (*lost, float(rng.uniform(*_RUBBING)), float(rng.uniform(*_BEND)))


@dataclass(frozen=True)
class Softening:
    """Of filled rubber with strain, as Kraus has it, exponents free: r is a power of the strain."""

    k: float
    """Lost at the reference strain."""
    most: float
    """What can be lost at all."""
    power: float = 1.0
    """Rubbers have 0.8 to 1.3."""
    rubbing: float = 0.0
    """Loss modulus gained where half of what can be lost is lost, over what can be: its largest."""
    bend: float = 0.5
    """How steeply that rises and falls: Kraus has a half."""

    def factor(self, strain: Array, reference: float) -> Complex:
        """On the modulus at a strain; `reference` is that at which `k` is lost. Shape of `strain`."""
        r = (strain / reference) ** self.power * self.k / (self.most - self.k)
        gained = self.rubbing * (4 * r / (1 + r) ** 2) ** self.bend
        return np.asarray(1 - self.most * (r / (1 + r) - 1j * gained))


@dataclass(frozen=True)
class StillAir:
    """Still air on both faces, about the simulated rig's own lattice of vortex rings."""

    name: ClassVar[str] = "air_added_mass"

    density_kg_m3: float

    @property
    def air_kg_m3(self) -> float:
        """Its density."""
        return self.density_kg_m3


@dataclass(frozen=True)
class Attachment:
    """Something hung on the plate at a point; stiffness and force are across the plate."""

    x_m: float
    y_m: float
    stiffness_n_m: Complex
    """Dynamic, against the plate's motion relative to the base. Shape (points,)."""
    force_n: Complex
    """On the plate per acceleration of the base. Shape (points,)."""


@dataclass(frozen=True)
class Setting:
    """What severities are chosen by."""

    plate: TruePlate
    """Without effects."""
    resonances_hz: tuple[float, ...]
    """The three that are measured."""
    duration_s: float
    """Of the sweep."""


@dataclass(frozen=True)
class Hidden:
    """An effect with its severity as fields. `draw` makes one that matters on a plate."""

    name: ClassVar[str]
    """As the diagnosis calls it, or what it is where no catalogue has it."""
    groups: ClassVar[str] = "whole"
    """Whose moduli differ within the core: see `reduced`."""
    changes_solid: ClassVar[bool] = False
    """Whether the clean plate's basis will not do."""
    place: ClassVar[str]
    """Where it sits; a pair comes from two places."""
    near: ClassVar[tuple[str, ...]] = ()
    """Other names of the catalogue that would not be wrong."""
    in_catalogue: ClassVar[bool] = True
    on_request: ClassVar[bool] = False
    """Whether a campaign hides it only where it is asked for by name."""

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "Hidden":
        """The effect at a random severity."""
        raise NotImplementedError

    @property
    def facts(self) -> dict[str, Any]:
        """Its severity as JSON has it."""
        return asdict(self)

    def plate(self, true: TruePlate) -> TruePlate:
        """The plate as it is with the effect, where only its sizes or metals differ."""
        return true

    def build(self, build: Build, true: TruePlate) -> Build:
        """What else differs in the solid."""
        return build

    def at_hammer(self, plate: TruePlate, build: Build) -> tuple[TruePlate, Build]:
        """The bare plate of the hammer test: only what sits in the substrate comes along."""
        return plate, build

    def stirred(self, true: TruePlate) -> tuple[Field, ...]:
        """Shares of the core whose forces the basis shall answer, as they vary from point to point."""
        return ()

    @property
    def air_kg_m3(self) -> float:
        """Density of the air around the plate."""
        return 0.0

    def points(self) -> tuple[tuple[float, float], ...]:
        """Where it hangs on."""
        return ()

    def attached(self, omega: Array, motion: BaseMotion, width_m: float) -> tuple[Attachment, ...]:
        """Things that hang on the plate and move with it. `omega` of shape (points,)."""
        return ()

    def ratios(self, ratios: Array) -> Array:
        """Remaining damping of the treated plate. Shape (modes,)."""
        return ratios

    def paused(self, schedule: Schedule) -> Schedule:
        """The sweep with a pause in it."""
        return schedule

    def frequency_factor(self, time_s: Array, x: Array, length_m: float) -> Array | None:
        """Factor on the frequency at which the law is read, at each point and group of bricks; None: one.

        Shape (points, groups); `x` in m of shape (groups,).
        """
        return None

    def motion(self, motion: BaseMotion, omega: Array) -> BaseMotion:
        """How else the base moves. `omega` of shape (points,)."""
        return motion

    def spot(self, spot_m: tuple[float, float], true: TruePlate) -> tuple[float, float]:
        """Where the laser really points."""
        return spot_m

    def channel(self, velocity_s: Complex, omega: Array, base_s: Complex) -> Complex:
        """What the velocity channel makes of a velocity per base acceleration; `base_s` is the base's own.

        In s, shape (points,).
        """
        return velocity_s

    def reference(self, base: Complex, omega: Array) -> Complex:
        """What the reference channel makes of the acceleration of the plate's root. Shape (points,)."""
        return base
