"""`viscorig identify`: the core's law from a sweep."""

from dataclasses import replace
from pathlib import Path

import click

from fitting.pointwise import phase_is_kept
from instrument.cli.options import figures_option, file_argument, json_option
from instrument.cli.output import Output
from instrument.cli.print_identification import print_bare_plate, print_identification
from instrument.cli.reading import read_data, reading_options
from instrument.models.identification import Identified, Method
from instrument.models.identification import identify as identify_sweep
from instrument.models.pointwise import pointwise_of
from instrument.progress import bar
from instrument.results.identification_facts import bare_plate_facts, identification_facts
from instrument.results.pointwise_facts import second_look_facts
from instrument.results.pointwise_figures import save_pointwise_figure


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
@click.option(
    "--pointwise",
    is_flag=True,
    help="Also G* band by band without a law, and whether G' and eta are those of one causal core.",
)
@figures_option("With --pointwise: save the law band by band as PNG.")
@json_option
def identify(
    data: Path,
    specimen: Path | None,
    method: Method,
    hammer: Path | None,
    no_hammer: bool,
    no_viscous_damping: bool,
    pointwise: bool,
    figures: Path | None,
    json_path: str | None,
) -> None:
    """The core's complex shear modulus from DATA, with its uncertainty.

    DATA is a sweep (.csv), a recorded session (.h5), or an FRF of the pickup over the base's acceleration
    (.csv, .uff, .unv, .mat).
    """
    if pointwise and method == "paper":
        raise click.UsageError("--pointwise and --method paper: expected the direct method")
    if figures is not None and not pointwise:
        raise click.UsageError("--figures shows the law band by band, expected --pointwise with it")
    out = Output(json_path)
    given = read_data(out, data, specimen, hammer, no_hammer=no_hammer)
    read = given.specimen
    if no_viscous_damping:
        read = replace(read, modal_ratios=())
    if pointwise:
        # Said before the work, not after it.
        phase_is_kept(given.sweep)
    found: Identified = identify_sweep(given.sweep, read, method, bar, given.modes)
    print_identification(out, found, given.sweep, read)
    facts = identification_facts(found, given.sweep)
    if found.bare is not None:
        print_bare_plate(out, found.bare, read)
        facts["hammer"] = bare_plate_facts(found.bare, read)
    if pointwise:
        bands = pointwise_of(found, given.sweep)
        out.say(bands.words)
        facts |= second_look_facts(bands)
        if figures is not None:
            out.say(f"saved {save_pointwise_figure(bands, found.result.band, figures)}")
    out.result({**facts, **given.facts})
