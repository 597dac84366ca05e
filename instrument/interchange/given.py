"""What is to be identified: a sweep, its plate and its hammer test, whatever file they come in."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen, Beam
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.identification import IdentificationResult
from instrument.facts.session_result import SessionResult
from instrument.files.file_kind import HAMMER_TEST, kind_of_file
from instrument.files.hammer_file import HammerModes, read_hammer
from instrument.files.structure_file import read_structure
from instrument.files.sweep_file import SweepFile, read_sweep
from instrument.interchange.base_frf import file_of_foreign, is_frf_csv, sweep_of_foreign, sweep_of_frf_csv
from instrument.interchange.files_of import files_of
from instrument.interchange.identified import session_modes, session_sweep
from instrument.interchange.level_remark import level_remark
from instrument.interchange.readers import is_foreign
from instrument.models.files import File, spots_of
from instrument.results.session_result import recorded_result
from instrument.session.contents import Contents, contents_of
from instrument.session.points import is_one_mounting, with_spots
from instrument.session.storage import SessionFile

R = TypeVar("R", IdentificationResult, DiagnosisResult)

SESSION_ENDINGS = (".h5", ".hdf5")


@dataclass(frozen=True)
class Given:
    """What the files of a command describe together."""

    specimen: AnySpecimen
    sweep: Sweep
    modes: HammerModes | None
    """Of the hammer test that is to take part."""
    session: str = ""
    """Its name, where the data are one."""
    reads: str = ""
    """What the session's laser reads: relative or absolute velocities."""
    remark: str = ""
    """For people, where a file leaves something to say."""
    recorded: SessionResult | None = None
    """What a session ended with, where it was diagnosed and its specimen is its own."""
    diagnosis: DiagnosisResult | None = None
    """A session's own, where specimen and hammer test are its own too."""
    temperature_c: float | None = None
    """Mean over the points of a session or a column, where it was measured."""
    with_masses: tuple[File, ...] = ()
    """The data of each clamping, known mass that a run put on the plate and place where it was struck; empty
    where there is none."""
    temperature_range_c: tuple[float, float] | None = None
    """Lowest and highest temperature of a column."""
    level_remark: str = ""
    """For people, of levels far from the base that was read: only where the data are not asked about."""

    @property
    def plate(self) -> PlateSpecimen:
        """The specimen where only a plate will do. Raises `BadInput`."""
        if not isinstance(self.specimen, PlateSpecimen):
            raise BadInput(f"the specimen is a {self.specimen.kind}, expected a plate")
        return self.specimen

    def files(self, name: str = "", number: int = 1) -> list[File]:
        """The data as files under one law, each of their spots for itself; `number` is that of their file."""
        return list(self.with_masses) or spots_of(self.sweep, self.specimen, name, number)

    def said(self, result: R) -> R:
        """A result of these data, which says whose they are."""
        if not self.session:
            known = isinstance(result, IdentificationResult) and self.temperature_c is not None
            return result.but(temperature_c=self.temperature_c) if known else result
        said = result.but(session=self.session, reads=self.reads)
        of_session = isinstance(said, IdentificationResult) and self.recorded is not None
        return said.but(session_result=self.recorded) if of_session else said


def is_session(data: Path) -> bool:
    """Whether a file is a session, by its ending."""
    return data.suffix.lower() in SESSION_ENDINGS


def read_given(data: Path, specimen: Path | None, hammer: Path | None, *, own_hammer: bool = True) -> Given:
    """Read data, specimen and hammer test; `own_hammer`: a session's own where none is named.

    A hammer test is the JSON of `viscorig damping`, or a session that has one.

    Raises `BadInput`, `FittingError`.
    """
    _refuse_another(data)
    if is_session(data):
        given = _of_session(data, specimen, own_hammer=hammer is None and own_hammer)
    else:
        given = _of_sweep(data, specimen)
        read, sweep = at_its_spot(data, given.specimen, given.sweep)
        given = replace(given, specimen=read, sweep=sweep)
    return given if hammer is None else replace(given, modes=hammer_of(hammer))


def _refuse_another(data: Path) -> None:
    """Raise `BadInput` for a file of this program that holds no data, and for a folder."""
    found = "" if is_foreign(data) and data.is_file() else kind_of_file(data)
    if not found and data.suffix.lower() == ".toml" and data.is_file():
        found = "a TOML file"
    if found not in ("", "a table", "a session"):
        more = "; it goes with --hammer" if found == HAMMER_TEST else ""
        raise BadInput(f"{data}: {found}, expected data: a sweep, or a session{more}")


def hammer_of(path: Path) -> HammerModes:
    """The modes of the JSON of `viscorig damping`, or of a session's own test. Raises `BadInput`."""
    if not is_session(path):
        return read_hammer(path)
    with SessionFile(path) as session:
        modes = session_modes(contents_of(session, with_hits=False))
    if modes is None:
        raise BadInput(f"{path}: no accepted mode of a bare plate in this session, expected its hammer test")
    return modes


def _of_sweep(data: Path, specimen: Path | None) -> Given:
    if specimen is None:
        raise BadInput("Missing option '--specimen': a sweep does not say which plate it was")
    read = read_structure(specimen)
    level, drive = read.drive_amplitude, read.drive
    foreign = is_foreign(data)
    if foreign and drive == "force":
        return Given(read, sweep_of_foreign(data, level, drive), None)
    if not foreign and is_frf_csv(data):
        over = "the base's acceleration" if drive == "base" else "the force"
        said = f"an FRF: taken as the pickup over {over}"
        return Given(read, sweep_of_frf_csv(data, level), None, remark=said)
    file = file_of_one_mounting(data)
    sweep, warm, ends = file.sweep(level, drive), file.temperature_c, file.temperature_range_c
    off = level_remark(data, sweep, level, has_levels="level_g" in file.columns) if drive == "base" else ""
    return Given(
        read,
        sweep,
        None,
        reads=file.reads or "",
        remark=file.remark,
        level_remark=off,
        temperature_c=warm,
        temperature_range_c=ends,
    )


def file_of_one_mounting(data: Path) -> SweepFile:
    """The rows of a sweep, ours or another program's.

    Raises `BadInput`, also where the specimen was clamped anew or carried a known mass for some of them.
    """
    file = file_of_foreign(data) if is_foreign(data) else read_sweep(data)
    if any(cell.strip(" .0") for cell in file.unknown.get("mounting", [])):
        raise BadInput(
            f"{data}: column mounting: the plate was clamped anew for some rows, expected a file for each "
            "mounting (or the session itself)"
        )
    if any(cell.strip(" .0") for cell in file.unknown.get("mass_kg", [])):
        raise BadInput(
            f"{data}: column mass_kg: a known mass was on the plate in some rows, expected a file for each, "
            "its specimen with [[mass]] (or the session itself)"
        )
    return file


def at_its_spot(data: Path | str, read: AnySpecimen, sweep: Sweep) -> tuple[AnySpecimen, Sweep]:
    """The specimen read where the data were; several spots stay several. Raises `BadInput`."""
    which = sweep.pickup
    known = len(read.pickups_m) if isinstance(read, PlateSpecimen | Beam) else 1
    if which is None:
        if known > 1:
            raise BadInput(f"{data}: column pickup missing, expected it: the specimen has {known} pickups")
        return read, sweep
    wrong = which[(which < 0) | (which >= max(known, 1))]
    if wrong.size:
        expected = "0" if known < 2 else f"0 to {known - 1}"
        raise BadInput(f"{data}: column pickup: {wrong[0]}, expected {expected}: {_spots_words(known)}")
    if len(np.unique(which)) > 1:
        return read, sweep
    spot = read.at_pickup(int(which[0])) if isinstance(read, PlateSpecimen | Beam) and known else read
    return spot, replace(sweep, pickup=None)


def _spots_words(known: int) -> str:
    return "the specimen is read at one spot" if known < 2 else f"the specimen has {known} pickups"


def _of_session(data: Path, specimen: Path | None, *, own_hammer: bool) -> Given:
    with SessionFile(data) as session:
        contents = contents_of(session, with_hits=False)
    reads = contents.configuration.rig.vibrometer.reads
    read = contents.specimen if specimen is None else replace(read_structure(specimen), reads=reads)
    if read.kind != contents.specimen.kind:
        raise BadInput(f"{specimen}: a {read.kind}, expected a {contents.specimen.kind} as the session's own")
    modes = session_modes(contents) if own_hammer else None
    sweep = session_sweep(contents)
    files = files_of(sweep, contents.measured, read, contents.struck)
    read = with_spots(read, contents.measured) if isinstance(read, PlateSpecimen) else read
    name = contents.configuration.name
    hammer = f", its hammer test with {len(modes.frequency_hz)} modes" if modes is not None else ""
    said = f"session {name}: {len(sweep)} points, velocity {reads}{hammer}"
    diagnosis = contents.diagnosis.result if contents.diagnosis is not None else None
    own = specimen is None and own_hammer
    return Given(
        read,
        sweep,
        modes,
        name,
        reads,
        said,
        recorded_result(contents) if diagnosis is not None and specimen is None else None,
        diagnosis if own else None,
        _temperature_c(contents),
        () if is_one_mounting(contents.measured) and not contents.struck else tuple(files),
    )


def _temperature_c(contents: Contents) -> float | None:
    read = [p.temperature_c for p in contents.measured if p.temperature_c is not None]
    return float(np.mean(read)) if read else None
