"""`viscorig identify`: the core's law from a sweep."""

from dataclasses import replace
from pathlib import Path

import click

from fitting.identification.bare_plate import fit_bare_plate, with_bare_plate
from instrument.cli.options import file_argument, json_option
from instrument.cli.output import Output
from instrument.cli.print_identification import print_bare_plate, print_identification
from instrument.files.hammer_file import read_hammer
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.identification import Identified, Method
from instrument.identification import identify as identify_sweep
from instrument.identification_facts import bare_plate_facts, identification_facts
from instrument.progress import bar


@click.command()
@file_argument("data")
@click.option(
    "--specimen", type=click.Path(path_type=Path), required=True, help="SPECIMEN.toml; its law is the start."
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
    help="JSON of 'viscorig damping' on the bare plate: its ratios, and the substrate's stiffness.",
)
@click.option(
    "--no-viscous-damping",
    is_flag=True,
    help="Leave the remaining viscous damping out, as in the paper's Fig. 10.",
)
@json_option
def identify(
    data: Path,
    specimen: Path,
    method: Method,
    hammer: Path | None,
    no_viscous_damping: bool,
    json_path: str | None,
) -> None:
    """The core's complex shear modulus from the sweep DATA (CSV), with its uncertainty."""
    out = Output(json_path)
    read = read_specimen(specimen)
    bare = None
    if hammer is not None:
        bare = fit_bare_plate(read, *read_hammer(hammer))
        read = with_bare_plate(read, bare)
    if no_viscous_damping:
        read = replace(read, modal_ratios=())
    sweep = read_sweep(data).sweep(read.base_acceleration_m_s2)
    found: Identified = identify_sweep(sweep, read, method, bar)
    print_identification(out, found, sweep)
    facts = identification_facts(found, sweep)
    if bare is not None:
        print_bare_plate(out, bare, read)
        facts["hammer"] = bare_plate_facts(bare, read)
    out.result(facts)
