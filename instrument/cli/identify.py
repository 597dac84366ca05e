"""`viscorig identify`: the core's law from a sweep."""

from dataclasses import replace
from pathlib import Path

import click

from fitting.identification.bare_plate import fit_bare_plate
from instrument.cli.options import file_argument, json_option
from instrument.cli.output import Output
from instrument.cli.print_identification import print_bare_plate, print_identification
from instrument.cli.reading import read_data, reading_options
from instrument.identification import Identified, Method
from instrument.identification import identify as identify_sweep
from instrument.identification_facts import bare_plate_facts, identification_facts
from instrument.progress import bar


@click.command()
@file_argument("data")
@reading_options
@click.option(
    "--method",
    type=click.Choice(["direct", "paper"]),
    default="direct",
    show_default=True,
    help="Bounded least squares on the full equation, or the paper's Eq. (20) to (25) on real modes.",
)
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

    DATA is a sweep (.csv), a recorded session (.h5), or an FRF of the pickup over the base's acceleration
    (.csv, .uff, .unv, .mat).
    """
    out = Output(json_path)
    given = read_data(out, data, specimen, hammer, no_hammer=no_hammer)
    read = given.specimen
    if no_viscous_damping:
        read = replace(read, modal_ratios=())
    found: Identified = identify_sweep(given.sweep, read, method, bar, given.modes)
    print_identification(out, found, given.sweep)
    facts = identification_facts(found, given.sweep)
    if given.modes is not None:
        bare = fit_bare_plate(read, *given.modes)
        print_bare_plate(out, bare, read)
        facts["hammer"] = bare_plate_facts(bare, read)
    out.result({**facts, **given.facts})
