"""`viscorig identify`: the core's law from a sweep."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import click

from fitting.identification.bare_plate import fit_bare_plate, with_bare_plate
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.cli.options import file_argument, json_option
from instrument.cli.output import Output
from instrument.cli.print_identification import print_bare_plate, print_identification
from instrument.files.hammer_file import HammerModes, read_hammer
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.identification import Identified, Method
from instrument.identification import identify as identify_sweep
from instrument.identification_facts import bare_plate_facts, identification_facts
from instrument.interchange.contents import contents_of
from instrument.interchange.identified import session_modes, session_sweep
from instrument.progress import bar
from instrument.session.storage import SessionFile

_SESSION_ENDINGS = (".h5", ".hdf5")


@click.command()
@file_argument("data")
@click.option(
    "--specimen",
    type=click.Path(path_type=Path),
    help="SPECIMEN.toml; its law is the start. A session has its own.",
)
@click.option(
    "--method",
    type=click.Choice(["direct", "paper"]),
    default="direct",
    show_default=True,
    help="Bounded least squares on the full equation, or the paper's Eq. (20) to (25) on real modes.",
)
@click.option(
    "--hammer",
    type=click.Path(path_type=Path),
    help="JSON of 'viscorig damping' on the bare plate: its ratios, and the substrate's stiffness. "
    "A session has its own.",
)
@click.option("--no-hammer", is_flag=True, help="Leave a session's own hammer test out.")
@click.option(
    "--no-viscous-damping",
    is_flag=True,
    help="Leave the remaining viscous damping out, as in the paper's Fig. 10.",
)
@json_option
def identify(
    data: Path,
    specimen: Path | None,
    method: Method,
    hammer: Path | None,
    no_hammer: bool,
    no_viscous_damping: bool,
    json_path: str | None,
) -> None:
    """The core's complex shear modulus from DATA, with its uncertainty.

    DATA is a sweep (.csv) or a recorded session (.h5).
    """
    out = Output(json_path)
    if hammer is not None and no_hammer:
        raise click.UsageError("--hammer and --no-hammer exclude each other")
    is_session = data.suffix.lower() in _SESSION_ENDINGS
    own_hammer = hammer is None and not no_hammer
    given = _of_session(out, data, specimen, own_hammer=own_hammer) if is_session else _of_csv(data, specimen)
    read, bare = given.specimen, None
    modes = read_hammer(hammer) if hammer is not None else given.modes
    if modes is not None:
        bare = fit_bare_plate(read, *modes)
        read = with_bare_plate(read, bare)
    if no_viscous_damping:
        read = replace(read, modal_ratios=())
    found: Identified = identify_sweep(given.sweep, read, method, bar)
    print_identification(out, found, given.sweep)
    facts = identification_facts(found, given.sweep)
    if bare is not None:
        print_bare_plate(out, bare, read)
        facts["hammer"] = bare_plate_facts(bare, read)
    out.result({**facts, **given.facts})


@dataclass(frozen=True)
class _Given:
    specimen: Specimen
    sweep: Sweep
    modes: HammerModes | None
    """Of the data's own hammer test, where it is to take part."""
    facts: dict[str, Any]


def _of_csv(data: Path, specimen: Path | None) -> _Given:
    if specimen is None:
        raise click.UsageError("Missing option '--specimen': a sweep does not say which plate it was")
    read = read_specimen(specimen)
    return _Given(read, read_sweep(data).sweep(read.base_acceleration_m_s2), None, {})


def _of_session(out: Output, data: Path, specimen: Path | None, *, own_hammer: bool) -> _Given:
    with SessionFile(data) as session:
        contents = contents_of(session, with_hits=False)
    reads = contents.configuration.rig.vibrometer.reads
    read = contents.specimen if specimen is None else replace(read_specimen(specimen), reads=reads)
    modes = session_modes(contents) if own_hammer else None
    sweep = session_sweep(contents, read)
    name = contents.configuration.name
    hammer = f", its hammer test with {len(modes.frequency_hz)} modes" if modes is not None else ""
    out.say(f"session {name}: {len(sweep)} points, velocity {reads}{hammer}\n")
    return _Given(read, sweep, modes, {"session": name, "reads": reads})
