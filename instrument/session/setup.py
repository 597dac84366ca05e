"""What the analysis is told of a session beside its events."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from fitting.dynamics.bare_modes import CarriedSensor
from fitting.dynamics.real_modes import real_modes
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.structures import Beam
from fitting.structures.small_modes import small_modes
from instrument.errors import BadInput
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.rig_file import Channels, RigDocument
from instrument.files.specimen_file import SpecimenDocument, specimen_of
from instrument.files.structure_file import AnyDocument, ShearPairDocument
from instrument.hammer_test.analysis import HammerSettings
from instrument.session.configuration import Configuration
from instrument.stepped_sine.settings import Dwell, LevelControl, Limits, Settle, SweepSettings

_DECAYED = 0.01
"""Of its start, to which the slowest mode falls within the record."""
LONGEST_RECORD_S = 60.0
"""A hit is waited for and kept in memory: longer ones have to be asked for."""
_RECORD_WITHOUT_RATIOS_S = 8.0
"""Where no ratio is stated: 0.3 % at 30 Hz falls to 1 % in it."""

_OF_METAL = 1e-3
"""Of critical: what joints and air take of a bare beam."""


@dataclass(frozen=True)
class Setup:
    """What the analysis has to know beside the events; all of it is kept with a session."""

    sensors: Channels
    sweep: SweepSettings
    hammer: HammerSettings | None


def setup_of(configuration: Configuration) -> Setup:
    """What the analysis is told."""
    experiment, rig = configuration.experiment, configuration.rig
    return Setup(rig.channels, sweep_settings(experiment, rig), hammer_settings(configuration))


def sweep_settings(experiment: ExperimentDocument, rig: RigDocument) -> SweepSettings:
    """Of the experiment, within the rig's limits."""
    s, r = experiment.sweep, rig.limits
    if s is None:
        return SweepSettings()
    limits = Limits(
        base_m_s2=_lower(s.limits.base_m_s2, r.base_m_s2),
        velocity_m_s=_lower(s.limits.velocity_m_s, r.velocity_m_s),
        travel_m=1e-3 * _lower(s.limits.travel_mm, r.travel_mm),
        drive_v=_lower(s.limits.drive_v, r.drive_v),
    )
    control = LevelControl(
        s.control.tolerance_percent / 100, s.control.abort_percent / 100, ramp_s=s.control.ramp_s
    )
    settle = Settle(s.settle.tolerance_percent / 100, most_s=s.settle.most_s)
    return SweepSettings(control, settle, Dwell(s.dwell.cycles, s.dwell.least_s, s.dwell.most_s), limits)


def hammer_settings(configuration: Configuration) -> HammerSettings | None:
    """Of the experiment; the record long enough for the slowest mode where it is left to us.

    Raises `BadInput` where the rig has no channel for force or response.
    """
    h = configuration.experiment.hammer
    if h is None:
        return None
    for name in ("force", "response"):
        if getattr(configuration.rig.channels, name) is None:
            raise BadInput(f"rig: channels.{name}: missing, the hammer test needs it")
    record_s = _record_s(configuration.specimen) if h.record_s == "auto" else h.record_s
    response = configuration.rig.channels.response
    mass_kg = 1e-3 * response.mass_g if response else 0.0
    sensor = CarriedSensor(mass_kg, 1e-3 * h.response_x_mm, 1e-3 * h.response_y_mm) if mass_kg else None
    return HammerSettings(h.hits, record_s, h.pre_trigger_s, (h.band_hz[0], h.band_hz[1]), sensor)


def _record_s(document: AnyDocument) -> float:
    if isinstance(document, ShearPairDocument):
        raise BadInput(
            "[hammer]: the hammer test is of a bare plate or beam, expected an experiment without it"
        )
    return record_length_s(
        specimen_of(document) if isinstance(document, SpecimenDocument) else document.specimen()
    )


def record_length_s(specimen: PlateSpecimen | Beam) -> float:
    """`decay_s`, as far as a record goes by itself."""
    return min(decay_s(specimen), LONGEST_RECORD_S)


@lru_cache(maxsize=8)
def decay_s(specimen: PlateSpecimen | Beam) -> float:
    """Until the slowest mode of the bare specimen has decayed to 1 %, from the ratios that a plate states.

    At the damping of metal and its joints for a beam, whose file states none.
    """
    if isinstance(specimen, Beam):
        bare = replace(specimen, core=None, constraining=None, both_sides=False)
        first = small_modes(bare, None, 1)[0].frequency_hz
        return _until(2 * np.pi * first * (_OF_METAL + bare.substrate.loss_factor / 2))
    ratios = np.array(specimen.modal_ratios)
    if not np.any(ratios > 0):
        return _RECORD_WITHOUT_RATIOS_S
    decay = ratios * real_modes(Plate(specimen.bare), 0.0, len(ratios)).omega
    return _until(float(decay[decay > 0].min()))


def _until(slowest: float) -> float:
    return round(-np.log(_DECAYED) / slowest + 0.5)


def _lower(a: float | None, b: float) -> float:
    return b if a is None else min(a, b)
