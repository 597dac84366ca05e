"""`viscorig campaign`: how often a law or a hidden effect is found, by simulated cases."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import click

from instrument.campaign.beams.cases import KINDS as BEAM_KINDS
from instrument.campaign.beams.judged import diagnosed as beam_diagnosed
from instrument.campaign.beams.judged import identified as beam_identified
from instrument.campaign.beams.run import beam_jobs, run_beams, write_beam_summary
from instrument.campaign.beams.visible import visible_chi2 as beam_visible
from instrument.campaign.cases import KINDS as PLANT_KINDS
from instrument.campaign.plates.apart import apart_jobs, run_apart, write_apart_summary
from instrument.campaign.plates.cases import KINDS as PLATE_KINDS
from instrument.campaign.plates.judged import diagnosed, diagnosed_without_the_truth, identified
from instrument.campaign.plates.run import plate_jobs, run_plates, write_plate_summary
from instrument.campaign.plates.visible import visible_chi2
from instrument.campaign.plates.weak_effects import WEAK
from instrument.campaign.run import jobs_of, run_campaign, write_summary
from instrument.cli.options import NumberRange
from instrument.errors import BadInput
from instrument.progress import bar


@click.group()
def campaign() -> None:
    """For developers: effects hidden in simulated specimens, and how often they are found.

    FOLDER keeps a line of JSON for each case, and a summary; the same command goes on where it stopped.
    """


def _of_kinds(kinds: Sequence[str]) -> Callable[[Callable[..., None]], click.Command]:
    """A campaign whose cases are of these kinds: where it is kept, which cases, on how many processes."""
    folder = click.argument("folder", type=click.Path(path_type=Path, file_okay=False))
    options = (
        click.option(
            "--count", type=click.IntRange(min=1), default=300, show_default=True, help="Cases to draw."
        ),
        click.option(
            "--seed",
            type=click.IntRange(min=0),
            default=1000,
            show_default=True,
            help="Of the first of them.",
        ),
        click.option(
            "--kind", "kinds", type=click.Choice(kinds), multiple=True, help="Only these; may be repeated."
        ),
        click.option(
            "--workers", type=click.IntRange(min=1), default=2, show_default=True, help="Processes."
        ),
    )

    def command(run: Callable[..., None]) -> click.Command:
        for option in reversed(options):
            run = option(run)
        return campaign.command()(folder(run))

    return command


_exact = click.option("--exact", is_flag=True, help="What is stated is exact.")
_law_alone = click.option("--law-alone", is_flag=True, help="Identify, and diagnose nothing.")
_shows = click.option(
    "--shows",
    type=NumberRange(min=0),
    help="Where what is hidden shows by less than this in chi-square, beside law, tolerances and hammer "
    "test, the case is drawn and not diagnosed.",
)


def _refuse_beside_law_alone(law_alone: bool, shows: float | None, without_truth: bool = False) -> None:
    """Raises `BadInput` for what only a diagnosis has a use for."""
    for name, given in (("--shows", shows is not None), ("--without-truth", without_truth)):
        if law_alone and given:
            raise BadInput(f"{name} is of diagnoses, expected no --law-alone beside it")


@_of_kinds(PLANT_KINDS)
@click.option(
    "--taken-out/--no-taken-out",
    default=True,
    show_default=True,
    help="Diagnose single effects once more without the true one in the catalogue.",
)
def plant(folder: Path, count: int, seed: int, kinds: tuple[str, ...], workers: int, taken_out: bool) -> None:
    """Diagnose sweeps of the published plate's 3D plant, everything stated exactly."""
    lines = run_campaign(
        jobs_of(count, seed, kinds), folder, taken_out=taken_out, workers=workers, progress=bar
    )
    click.echo(write_summary(lines, folder))


@_of_kinds(PLATE_KINDS)
@_exact
@_law_alone
@_shows
@click.option("--one-piece", is_flag=True, help="One segment through many resonances.")
@click.option("--without-truth", is_flag=True, help="What is hidden is not in the catalogue.")
def plates(
    folder: Path,
    count: int,
    seed: int,
    kinds: tuple[str, ...],
    workers: int,
    exact: bool,
    law_alone: bool,
    shows: float | None,
    one_piece: bool,
    without_truth: bool,
) -> None:
    """Diagnose ten solid plates, each known only within a careful laboratory's tolerances."""
    _refuse_beside_law_alone(law_alone, shows, without_truth)
    run = partial(run_plates, plate_jobs(count, seed, kinds), folder, exact=exact, one_piece=one_piece)
    judged = diagnosed_without_the_truth if without_truth else diagnosed
    alone = partial(run, identify=identified)
    traced = partial(run, diagnose=judged, visible=visible_chi2, least=shows)
    found = (alone if law_alone else traced)(workers=workers, progress=bar)
    click.echo(write_plate_summary(found, folder))


@_of_kinds(BEAM_KINDS)
@_exact
@_law_alone
@_shows
def beams(
    folder: Path,
    count: int,
    seed: int,
    kinds: tuple[str, ...],
    workers: int,
    exact: bool,
    law_alone: bool,
    shows: float | None,
) -> None:
    """Diagnose ten solid beams, shaken or struck, known within tolerances too."""
    _refuse_beside_law_alone(law_alone, shows)
    run = partial(run_beams, beam_jobs(count, seed, kinds), folder, exact=exact)
    alone = partial(run, identify=beam_identified)
    traced = partial(run, diagnose=beam_diagnosed, visible=beam_visible, least=shows)
    found = (alone if law_alone else traced)(workers=workers, progress=bar)
    click.echo(write_beam_summary(found, folder))


@_of_kinds(WEAK)
def apart(folder: Path, count: int, seed: int, kinds: tuple[str, ...], workers: int) -> None:
    """Diagnose solid plates with a weak effect, and measure what is proposed then, twice at most."""
    lines = run_apart(apart_jobs(count, seed, kinds), folder, workers=workers, progress=bar)
    click.echo(write_apart_summary(lines, folder))
