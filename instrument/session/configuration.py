"""What a session is kept with: experiment, rig and specimen as they were, versions, and what follows."""

import re
import shlex
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, BaseModel

from fitting.plugins import packages
from fitting.structures import AnySpecimen
from instrument.errors import BadInput
from instrument.files.beam_file import BeamDocument
from instrument.files.experiment_file import ExperimentDocument, read_experiment
from instrument.files.rig_file import RigDocument
from instrument.files.sensor_file import read_rig
from instrument.files.specimen_file import SpecimenDocument
from instrument.files.structure_file import (
    AnyDocument,
    ShearPairDocument,
    described,
    read_structure_document,
)

_NOT_IN_NAMES = re.compile(r"[/\\:\x00-\x1f\x7f]")
_LONGEST_NAME = 200


def _plain(name: str) -> str:
    """A name from a file is a name, never a path: files are called by it."""
    if name.startswith(".") or _NOT_IN_NAMES.search(name) or len(name) > _LONGEST_NAME:
        raise ValueError("expected a plain name without folders")
    return name


def _if_plain(name: str) -> str:
    """A name that is only shown; empty where it is none."""
    try:
        return _plain(name)
    except ValueError:
        return ""


class Configuration(BaseModel):
    """Kept in every session. The rig's `[simulation]` never is."""

    name: Annotated[str, AfterValidator(_plain)]
    created_utc: str
    versions: dict[str, str]
    experiment: ExperimentDocument
    rig: RigDocument
    specimen: AnyDocument
    command: str = ""
    """Which one began it: `run`, `hammer` or `sweep`; empty in sessions of older versions."""
    experiment_file: Annotated[str, AfterValidator(_if_plain)] = ""
    """Name of the experiment's file, without its folder; empty in sessions of older versions."""

    def resumed(self, command: str, folder: Path | str) -> str:
        """What a person types to carry a run on from its folder."""
        file = self.experiment_file or "EXPERIMENT.toml"
        return shlex.join(["viscorig", command, file, "--resume", str(folder)])

    def the_specimen(self) -> AnySpecimen:
        """The specimen as the model is told, read as this rig's laser does."""
        return _as_read(self.specimen, self.rig)


@dataclass(frozen=True)
class Experiment:
    """An experiment file and all it names."""

    path: Path
    document: ExperimentDocument
    rig: RigDocument
    specimen: AnyDocument
    rig_path: Path
    specimen_path: Path

    def the_specimen(self) -> AnySpecimen:
        """The specimen as the model is told, read as this rig's laser does."""
        return _as_read(self.specimen, self.rig)

    def configuration(self, name: str, created_utc: str) -> Configuration:
        """What is kept with its session."""
        return Configuration(
            name=name,
            created_utc=created_utc,
            versions={p: version(p) for p in ("viscorig", "numpy", "scipy", "h5py")} | packages(),
            experiment=self.document,
            rig=self.rig.without_simulation(),
            specimen=self.specimen,
        )


def _as_read(specimen: AnyDocument, rig: RigDocument) -> AnySpecimen:
    return replace(described(specimen), reads=rig.vibrometer.reads)


def read_whole_experiment(path: Path) -> Experiment:
    """The experiment, its rig and its specimen. Raises `BadInput`."""
    document = read_experiment(path)
    rig_path = path.parent / document.rig
    specimen_path = path.parent / document.specimen
    rig = read_rig(rig_path)
    specimen = read_structure_document(specimen_path)
    if not isinstance(specimen, ShearPairDocument):
        _refuse_another_drive(specimen, specimen_path)
    return Experiment(path, document, rig, specimen, rig_path, specimen_path)


def _refuse_another_drive(specimen: SpecimenDocument | BeamDocument, specimen_path: Path) -> None:
    if specimen.excitation is not None and specimen.excitation.kind == "force":
        raise BadInput(
            f'{specimen_path}: excitation.kind: "force", but a rig shakes the base, expected "base"'
        )
    if len(specimen.pickups) > 1:
        raise BadInput(
            f"{specimen_path}: {len(specimen.pickups)} pickups, but a rig has one laser, expected one"
        )
