"""What every effect hidden in a beam is: where it may reach into solid, base, law. By default nowhere.

None of it shares a formula with the catalogue of the diagnosis.
"""

from dataclasses import asdict, dataclass
from typing import Any, ClassVar

import numpy as np

from campaign.beams.geometry import TrueBeam
from campaign.schedule import Schedule
from drivers.simulated.plant.solid_beam import BeamBuild
from fitting.arrays import Array, Complex


@dataclass(frozen=True)
class Hung:
    """Something hung on the middle line of the upper face; stiffness and force are across the beam."""

    x_m: float
    stiffness_n_m: Complex
    """Dynamic, against the beam's motion relative to the base. Shape (points,)."""
    force_n: Complex
    """On the beam per acceleration of the base. Shape (points,)."""


@dataclass(frozen=True)
class Setting:
    """What severities are chosen by."""

    beam: TrueBeam
    """Without effects."""
    resonances_hz: tuple[float, ...]
    """That are measured."""
    duration_s: float
    """Of the sweep."""


@dataclass(frozen=True)
class HiddenInBeam:
    """An effect with its severity as fields. `draw` makes one that matters on a beam."""

    name: ClassVar[str]
    """As the diagnosis calls it."""
    near: ClassVar[tuple[str, ...]] = ()
    """Other names of the catalogue that would not be wrong."""
    in_catalogue: ClassVar[bool] = True
    on_request: ClassVar[bool] = False
    """Whether a campaign hides it only where it is asked for by name."""
    strips: ClassVar[int] = 1
    """Of the core, that may differ in time."""

    @classmethod
    def able(cls, beam: TrueBeam) -> bool:
        """Whether it can be on a beam."""
        return True

    @classmethod
    def draw(cls, rng: np.random.Generator, at: Setting) -> "HiddenInBeam":
        """The effect at a random severity."""
        raise NotImplementedError

    @property
    def facts(self) -> dict[str, Any]:
        """Its severity as JSON has it."""
        return asdict(self)

    def beam(self, true: TrueBeam) -> TrueBeam:
        """The beam as it is with the effect, where only its sizes or metals differ."""
        return true

    def build(self, build: BeamBuild, true: TrueBeam) -> BeamBuild:
        """What else differs in the solid."""
        return build

    @property
    def root_loss(self) -> float:
        """Loss factor of the springs at the root."""
        return 0.0

    @property
    def air_kg_m3(self) -> float:
        """Density of the air around the beam."""
        return 0.0

    def places_m(self) -> tuple[float, ...]:
        """Where it hangs on."""
        return ()

    def hung(self, omega: Array, pitch: Complex, force_driven: bool) -> tuple[Hung, ...]:
        """Things that hang on the beam and move with it. `omega` of shape (points,), as `pitch`, in rad/m."""
        return ()

    def paused(self, schedule: Schedule) -> Schedule:
        """The sweep with a pause in it."""
        return schedule

    def frequency_factor(self, time_s: Array) -> Array | None:
        """Factor on the frequency at which the law is read, at each point; None: one. Shape (points,)."""
        return None

    def pitch(self, omega: Array) -> Complex:
        """Angular acceleration of the base per acceleration at each point, in rad/m. Shape (points,)."""
        return np.zeros(len(omega), complex)

    def reference(self, omega: Array) -> Complex:
        """What the reference channel reads of the acceleration of the root. Shape (points,)."""
        return np.ones(len(omega), complex)


def driven_by_base(beam: TrueBeam) -> bool:
    """Whether the base drives it."""
    return beam.force_m is None
