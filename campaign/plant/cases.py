"""A case: a sweep as the lab would hand it in, and what was hidden in it."""

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from campaign.draws import two_apart
from campaign.law import TrueLaw
from campaign.noise import NoiseFigures, draw_figures, peaks
from campaign.plant.channels import TrueChannels
from campaign.plant.hammer import hammer_test
from campaign.plant.materials import draw_material, draw_strange_material
from campaign.plant.response import steady
from campaign.plant.schedule import draw_schedule
from campaign.plant.severities import OF_THE_CHANNELS_ALONE, PLACES, Severity, draw_severity
from campaign.schedule import Schedule, draw_levels
from drivers.simulated.plant.effects import (
    AddedMass,
    AirAddedMass,
    AmplitudeSoftening,
    BaseRocking,
    ClampCompliance,
    ClampFriction,
    CoreThickness,
    Effects,
    FixtureResonance,
    PartialDebond,
    SpotOffset,
    SubstrateStiffness,
    TemperatureDrift,
    ViscousDamping,
)
from fitting.arrays import Array, Complex
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from instrument.files.specimen_file import read_specimen
from instrument.simulated_case import case_file

NONE, PAIR = "none", "pair"
KINDS = (NONE, *PLACES, PAIR)
"""`none`, each effect by its name, `pair`."""
_HAMMER_SHARE = 0.5
"""Of cases: with and without a hammer test are compared."""

_PLANT: dict[str, Any] = {
    "clamp_compliance": ClampCompliance,
    "spot_offset": SpotOffset,
    "added_mass": AddedMass,
    "air_added_mass": AirAddedMass,
    "temperature_drift": TemperatureDrift,
    "partial_debond": PartialDebond,
    "amplitude_softening": AmplitudeSoftening,
    "viscous_damping": ViscousDamping,
    "base_rocking": BaseRocking,
    "fixture_resonance": FixtureResonance,
    "core_thickness": CoreThickness,
    "substrate_stiffness": SubstrateStiffness,
}


@dataclass(frozen=True)
class Truth:
    """The truth that a case hides from the diagnosis."""

    effects: dict[str, Severity]
    """By name; none, one or two."""
    law: TrueLaw
    noise: NoiseFigures

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the hidden effects."""
        return tuple(self.effects)


@dataclass(frozen=True)
class Case:
    """What a diagnosis is given, and the truth that it is not."""

    kind: str
    seed: int
    sweep: Sweep
    specimen: PlateSpecimen
    """The published plate as a user describes it."""
    hammer: tuple[Array, Array] | None
    """Natural frequencies in Hz and ratios of the bare plate, for `fit_bare_plate`."""
    truth: Truth


@cache
def nominal_specimen() -> PlateSpecimen:
    """The published plate with the published law as the start."""
    return read_specimen(case_file("specimen.toml"))


def draw(kind: str, seed: int) -> Case:
    """A random case of one of `KINDS`, always the same for the same seed."""
    rng = np.random.default_rng([seed, *kind.encode()])
    names = _names(kind, rng)
    schedule = draw_schedule(rng, draw_levels(rng, names))
    strange = "core_law" in names
    law = draw_strange_material(rng, schedule.frequency_hz) if strange else draw_material(rng)
    severities = {name: draw_severity(name, rng) for name in names}
    specimen = nominal_specimen()
    if "amplitude_softening" in severities:
        reference = _first_mode_strain(law, schedule, specimen.base_acceleration_m_s2)
        severities["amplitude_softening"]["reference_strain"] = reference
    truth = Truth(severities, law, draw_figures(rng))
    sweep = measured(truth, schedule, specimen.base_acceleration_m_s2, rng)
    hammer = hammer_test(plant_effects(severities), rng) if rng.random() < _HAMMER_SHARE else None
    return Case(kind, seed, sweep, specimen, hammer, truth)


def _names(kind: str, rng: np.random.Generator) -> tuple[str, ...]:
    if kind == NONE:
        return ()
    if kind != PAIR:
        if kind not in PLACES:
            raise ValueError(f"kind {kind!r}, expected one of {', '.join(KINDS)}")
        return (kind,)
    return two_apart(rng, {name: at for name, at in PLACES.items() if name not in OF_THE_CHANNELS_ALONE})


def _first_mode_strain(law: TrueLaw, schedule: Schedule, g_m_s2: float) -> float:
    """Largest core strain in the first segment at 1 g, before it softens."""
    f = np.unique(schedule.frequency_hz[schedule.segment == 1])
    strain = steady(Effects(), law.modulus, f, np.full(len(f), g_m_s2), np.zeros(len(f))).core_strain
    return float(strain.max())


def plant_effects(severities: dict[str, Severity]) -> Effects:
    """What of the hidden the plate itself does."""
    found = {name: _PLANT[name](**s) for name, s in severities.items() if name in _PLANT}
    effects = Effects(**found)
    friction = severities.get("clamp_friction")
    if friction is None:
        return effects
    springs = {key: value for key, value in friction.items() if key != "loss_factor"}
    return replace(
        effects,
        clamp_compliance=_PLANT["clamp_compliance"](**springs),
        clamp_friction=ClampFriction(float(friction["loss_factor"])),
    )


def channel_effects(severities: dict[str, Severity]) -> TrueChannels:
    """What of the hidden the channels do, but for hum."""

    def number(name: str, key: str, otherwise: float) -> float:
        return float(severities[name][key]) if name in severities else otherwise

    return TrueChannels(
        delay_s=number("channel_delay", "delay_s", 0.0),
        gain=number("gain_error", "factor", 1.0),
        absolute="absolute_velocity" in severities,
        level=number("level_error", "factor", 1.0),
    )


def clean(truth: Truth, schedule: Schedule, g_m_s2: float) -> Complex:
    """The reading over the base's true acceleration at each point, without noise or hum (s).

    Shape (points,).
    """
    channels = channel_effects(truth.effects)
    level_m_s2 = channels.level * schedule.level_g * g_m_s2
    plate = steady(
        plant_effects(truth.effects), truth.law.modulus, schedule.frequency_hz, level_m_s2, schedule.time_s
    )
    omega = 2 * np.pi * schedule.frequency_hz
    return channels.velocity_per_acceleration(plate.velocity_per_acceleration_s, omega)


def measured(truth: Truth, schedule: Schedule, g_m_s2: float, rng: np.random.Generator) -> Sweep:
    """The sweep as the rig would record it; `g_m_s2` is what a level of 1 g commands."""
    response = clean(truth, schedule, g_m_s2)
    channels = channel_effects(truth.effects)
    commanded = schedule.level_g * g_m_s2
    base = channels.level * commanded * truth.noise.drive(rng, len(commanded))
    still = response * channels.level * commanded
    velocity = response * base + truth.noise.added(rng, still, schedule.sweep)
    hum = truth.effects.get("mains_hum")
    if hum is not None:
        of_noise = truth.noise.fraction_of_peak * np.median(peaks(np.abs(still), schedule.sweep))
        humming = replace(channels, hum_m_s=float(hum["noises"]) * float(of_noise))
        velocity = velocity + humming.hum(schedule.frequency_hz, rng)
    return schedule.read(velocity, commanded, base)
