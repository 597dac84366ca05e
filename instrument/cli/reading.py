"""DATA of `identify` and `diagnose`: a sweep, its plate and its hammer test, whatever file they come in."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import click

from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.cli.output import Output
from instrument.files.hammer_file import HammerModes, read_hammer
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.interchange.base_frf import is_frf_csv, sweep_of_foreign, sweep_of_frf_csv
from instrument.interchange.identified import session_modes, session_sweep
from instrument.interchange.readers import is_foreign
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile

_SESSION_ENDINGS = (".h5", ".hdf5")

_OPTIONS = (
    click.option(
        "--specimen",
        type=click.Path(path_type=Path),
        help="SPECIMEN.toml; its law is the start. A session has its own.",
    ),
    click.option(
        "--hammer",
        type=click.Path(path_type=Path),
        help="JSON of 'viscorig damping' on the bare plate: its ratios, and the substrate's stiffness. "
        "A session has its own.",
    ),
    click.option("--no-hammer", is_flag=True, help="Leave a session's own hammer test out."),
)


@dataclass(frozen=True)
class Given:
    """What the data and the options gave."""

    specimen: Specimen
    sweep: Sweep
    modes: HammerModes | None
    """Of the hammer test that is to take part."""
    facts: dict[str, Any]
    """Of the session, for the JSON."""


def reading_options(command: Callable[..., None]) -> Callable[..., None]:
    """`--specimen`, `--hammer`, `--no-hammer`."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def read_data(
    out: Output, data: Path, specimen: Path | None, hammer: Path | None, *, no_hammer: bool
) -> Given:
    """Read DATA, its specimen and its hammer test. Raises `BadInput`, `UsageError`."""
    if hammer is not None and no_hammer:
        raise click.UsageError("--hammer and --no-hammer exclude each other")
    if data.suffix.lower() in _SESSION_ENDINGS:
        given = _of_session(out, data, specimen, own_hammer=hammer is None and not no_hammer)
    else:
        given = _of_sweep(out, data, specimen)
    return given if hammer is None else replace(given, modes=read_hammer(hammer))


def _of_sweep(out: Output, data: Path, specimen: Path | None) -> Given:
    if specimen is None:
        raise click.UsageError("Missing option '--specimen': a sweep does not say which plate it was")
    read = read_specimen(specimen)
    level = read.base_acceleration_m_s2
    if is_foreign(data):
        sweep = sweep_of_foreign(data, level)
    elif is_frf_csv(data):
        out.say("an FRF: taken as the pickup over the base's acceleration\n")
        sweep = sweep_of_frf_csv(data, level)
    else:
        sweep = read_sweep(data).sweep(level)
    return Given(read, sweep, None, {})


def _of_session(out: Output, data: Path, specimen: Path | None, *, own_hammer: bool) -> Given:
    with SessionFile(data) as session:
        contents = contents_of(session, with_hits=False)
    reads = contents.configuration.rig.vibrometer.reads
    read = contents.specimen if specimen is None else replace(read_specimen(specimen), reads=reads)
    modes = session_modes(contents) if own_hammer else None
    sweep = session_sweep(contents, read)
    name = contents.configuration.name
    hammer = f", its hammer test with {len(modes.frequency_hz)} modes" if modes is not None else ""
    out.say(f"session {name}: {len(sweep)} points, velocity {reads}{hammer}\n")
    return Given(read, sweep, modes, {"session": name, "reads": reads})
