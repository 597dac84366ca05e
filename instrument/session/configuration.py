"""What a session is kept with: experiment, rig and specimen as they were, versions, and what follows."""

from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path

import numpy as np
from pydantic import BaseModel

from fitting.bare_modes import Sensor
from fitting.plate import Plate
from fitting.real_modes import real_modes
from fitting.specimen import Specimen
from instrument.errors import BadInput
from instrument.files.experiment_file import ExperimentDocument, read_experiment
from instrument.files.rig_file import RigDocument
from instrument.files.specimen_file import SpecimenDocument, specimen_of
from instrument.files.toml import read_document
from instrument.hammer_test.analysis import HammerSettings
from instrument.stepped_sine.settings import Control, Dwell, Limits, Settle, SweepSettings
from instrument.stream.analysis import Setup

_DECAYED = 0.01
_LONGEST_RECORD_S = 60.0
_RECORD_WITHOUT_RATIOS_S = 8.0


class Configuration(BaseModel):
    """Kept in every session. The rig's `[simulation]` never is."""

    name: str
    created_utc: str
    versions: dict[str, str]
    experiment: ExperimentDocument
    rig: RigDocument
    specimen: SpecimenDocument

    def the_specimen(self) -> Specimen:
        """The plate as the model is told, read as this rig's laser does."""
        return _as_read(self.specimen, self.rig)


@dataclass(frozen=True)
class Experiment:
    """An experiment file and all it names."""

    path: Path
    document: ExperimentDocument
    rig: RigDocument
    specimen: SpecimenDocument
    rig_path: Path

    def the_specimen(self) -> Specimen:
        """The plate as the model is told, read as this rig's laser does."""
        return _as_read(self.specimen, self.rig)

    def configuration(self, name: str, created_utc: str) -> Configuration:
        """What is kept with its session."""
        return Configuration(
            name=name,
            created_utc=created_utc,
            versions={package: version(package) for package in ("viscorig", "numpy", "scipy", "h5py")},
            experiment=self.document,
            rig=self.rig.without_simulation(),
            specimen=self.specimen,
        )


def _as_read(specimen: SpecimenDocument, rig: RigDocument) -> Specimen:
    return replace(specimen_of(specimen), reads=rig.vibrometer.reads)


def read_whole_experiment(path: Path) -> Experiment:
    """The experiment, its rig and its specimen. Raises `BadInput`."""
    document = read_experiment(path)
    rig_path = path.parent / document.rig
    specimen_path = path.parent / document.specimen
    rig = read_document(rig_path, RigDocument)
    specimen = read_document(specimen_path, SpecimenDocument)
    return Experiment(path, document, rig, specimen, rig_path)


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
    control = Control(
        s.control.tolerance_percent / 100, s.control.abort_percent / 100, ramp_s=s.control.ramp_s
    )
    settle = Settle(s.settle.tolerance_percent / 100, most_s=s.settle.most_s)
    return SweepSettings(control, settle, Dwell(s.dwell.cycles, s.dwell.least_s, s.dwell.most_s), limits)


def hammer_settings(configuration: Configuration) -> HammerSettings | None:
    """Of the experiment; the record long enough for the slowest mode where it is left to us."""
    h = configuration.experiment.hammer
    if h is None:
        return None
    for name in ("force", "response"):
        if getattr(configuration.rig.channels, name) is None:
            raise BadInput(f"rig: channels.{name}: missing, the hammer test needs it")
    record_s = record_length_s(specimen_of(configuration.specimen)) if h.record_s == "auto" else h.record_s
    response = configuration.rig.channels.response
    mass_kg = 1e-3 * response.mass_g if response else 0.0
    sensor = Sensor(mass_kg, 1e-3 * h.response_x_mm, 1e-3 * h.response_y_mm) if mass_kg else None
    return HammerSettings(h.hits, record_s, h.pre_trigger_s, (h.band_hz[0], h.band_hz[1]), sensor)


def record_length_s(specimen: Specimen) -> float:
    """Until the slowest mode has decayed to 1 %, from the ratios the specimen states."""
    ratios = np.array(specimen.modal_ratios)
    if not np.any(ratios > 0):
        return _RECORD_WITHOUT_RATIOS_S
    decay = ratios * real_modes(Plate(specimen.bare), 0.0, len(ratios)).omega
    slowest = float(decay[decay > 0].min())
    return min(round(-np.log(_DECAYED) / slowest + 0.5), _LONGEST_RECORD_S)


def _lower(a: float | None, b: float) -> float:
    return b if a is None else min(a, b)
