"""What the simulated plate does that a model need not know of. Each is absent unless given.

To add one: a class here, a field of `Effects`, a line where `sandwich.py` or `shaken.py` uses it.
"""

from dataclasses import dataclass
from math import nan

from drivers.simulated.plant.law import MaxwellLaw

LOOSE = 0.01
"""What is left of the stiffness of a core that came loose."""


@dataclass(frozen=True)
class ClampCompliance:
    """Springs between the root face and the base. Along y the root stays rigid."""

    along_x_n_m3: float
    """Per area of the root face, 1e12 to 3e14 N/m^3."""
    along_z_n_m3: float
    """The same across the plate."""


@dataclass(frozen=True)
class ClampFriction:
    """Loss in the springs of `clamp_compliance` (without it: in springs of 1e14 N/m^3).

    Maxwell elements beside them, their loss factor almost even from 5 to 600 Hz; stiffness kept at 60 Hz.
    """

    loss_factor: float
    """0 to 0.3."""


@dataclass(frozen=True)
class SpotOffset:
    """The laser's spot beside where it is thought to be."""

    dx_m: float
    """Within 0.01 m."""
    dy_m: float
    """Within 0.01 m."""


@dataclass(frozen=True)
class AddedMass:
    """A point mass on the constraining layer."""

    mass_kg: float
    """0 to 0.02 kg."""
    x_m: float = nan
    """From the clamp, 0 to 0.3002 m on the published plate. On a beam it may be left out: at its tip, or
    midway between two clamps."""
    y_m: float = nan
    """From the long edge y = 0, 0 to 0.1999 m there; of no meaning on a beam."""


@dataclass(frozen=True)
class AirAddedMass:
    """Incompressible air on both faces, the plate unbaffled. It feels the plate's absolute motion."""

    density_kg_m3: float
    """0 to 1.3 kg/m^3."""


@dataclass(frozen=True)
class TemperatureDrift:
    """The core warms: kelvin (1 - exp(-t / time_constant)) at time t of the sample clock, shifted by WLF."""

    kelvin: float
    """In the end, -10 to 10 K."""
    time_constant_s: float = 600.0
    """30 to 5000 s."""
    c1: float = 9.0
    c2_kelvin: float = 120.0


@dataclass(frozen=True)
class PartialDebond:
    """The core's stiffness is `LOOSE` of what it was on a strip."""

    along: str
    """"x": a strip of all the width between two x; "y": of all the length between two y."""
    from_m: float
    to_m: float


@dataclass(frozen=True)
class AmplitudeSoftening:
    """G times (1 - k strain / reference), at least 0.3; strain is the amplitude, rms over the core.

    The factor follows the steady strain of the present drive with a time constant.
    """

    k: float
    """0 to 0.3."""
    reference_strain: float = 0.07
    """About that of 1 g at the first resonance."""
    time_constant_s: float = 1.0
    """0.3 to 10 s."""


@dataclass(frozen=True)
class ViscousDamping:
    """The treated plate's damping ratios are the bare plate's times a factor."""

    scale: float
    """0 to 3."""


@dataclass(frozen=True)
class BaseRocking:
    """The base pitches in proportion to its acceleration; positive lifts the tip with the base."""

    pitch_rad_m: float
    """Angular acceleration per acceleration of the base, -0.5 to 0.5 rad/m."""


@dataclass(frozen=True)
class FixtureResonance:
    """The base pitches through one resonance of the fixture: gain w0^2 / (w0^2 - w^2 + 2 i zeta w0 w)."""

    frequency_hz: float
    """50 to 400 Hz."""
    damping_ratio: float
    """0.005 to 0.1."""
    gain_rad_m: float
    """Angular acceleration per acceleration of the base far below the resonance, -0.2 to 0.2 rad/m."""


@dataclass(frozen=True)
class CoreThickness:
    """The core's thickness is nominal times a factor."""

    scale: float
    """0.9 to 1.1."""


@dataclass(frozen=True)
class SubstrateStiffness:
    """The substrate's Young's modulus is nominal times a factor."""

    scale: float
    """0.9 to 1.1."""


@dataclass(frozen=True)
class OtherLaw:
    """Another law than the fractional one."""

    law: MaxwellLaw


@dataclass(frozen=True)
class ByHand:
    """What somebody has changed, and said so."""

    spot_m: tuple[float, float] | None = None
    """Where the laser is meant to point; None for the specimen's spot."""
    mass: AddedMass | None = None
    """Of known size, beside any that is hidden."""
    mounting: int = 0
    """How often the plate was clamped anew."""


@dataclass(frozen=True)
class Effects:
    """Effects that are present on a simulated specimen. Fields are named as a diagnosis names the effects."""

    clamp_compliance: ClampCompliance | None = None
    clamp_friction: ClampFriction | None = None
    spot_offset: SpotOffset | None = None
    added_mass: AddedMass | None = None
    air_added_mass: AirAddedMass | None = None
    temperature_drift: TemperatureDrift | None = None
    partial_debond: PartialDebond | None = None
    amplitude_softening: AmplitudeSoftening | None = None
    viscous_damping: ViscousDamping | None = None
    base_rocking: BaseRocking | None = None
    fixture_resonance: FixtureResonance | None = None
    core_thickness: CoreThickness | None = None
    substrate_stiffness: SubstrateStiffness | None = None
    core_law: OtherLaw | None = None
