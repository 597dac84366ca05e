"""`python -m campaign`: how often a law or a hidden effect is found, by simulated cases."""

from collections.abc import Callable, Sequence
from functools import wraps
from pathlib import Path
from typing import Any

import click

from campaign.beams.cases import KINDS as BEAM_KINDS
from campaign.beams.judged import diagnosed as beam_diagnosed
from campaign.beams.judged import identified as beam_identified
from campaign.beams.run import ROTATION as BEAM_ROTATION
from campaign.beams.run import run_beams, write_beam_summary
from campaign.beams.visible import visible_chi2 as beam_visible
from campaign.plant.run import ROTATION as PLANT_ROTATION
from campaign.plant.run import run_plant, write_plant_summary
from campaign.plates.apart import run_apart, write_apart_summary
from campaign.plates.asked import Asked
from campaign.plates.cases import KINDS as PLATE_KINDS
from campaign.plates.judged import diagnosed, diagnosed_without_the_truth, identified
from campaign.plates.run import ROTATION as PLATE_ROTATION
from campaign.plates.run import run_plates, write_plate_summary
from campaign.plates.visible import visible_chi2
from campaign.plates.weak_effects import WEAK
from campaign.run import Job, in_rotation
from instrument.cli.main import SETTINGS, main
from instrument.cli.options import NumberRange
from instrument.cli.stopping import ended_as_by_a_person
from instrument.errors import BadInput
from instrument.progress import bar


@click.group(context_settings=SETTINGS)
@click.pass_context
def campaign(ctx: click.Context) -> None:
    """For developers: effects hidden in simulated specimens, and how often they are found.

    FOLDER keeps a line of JSON for each case, and a summary; the same command goes on where it stopped.
    """
    # SIGTERM ends the processes too, as Ctrl-C does.
    ctx.with_resource(ended_as_by_a_person(even_ignored=False))


def _of_kinds(
    rotation: Sequence[str], kinds: Sequence[str] = ()
) -> Callable[[Callable[..., None]], click.Command]:
    """A campaign that has these kinds in rotation, and on request others of `kinds`.

    What it runs is given the jobs, the folder and the number of processes, beside options of its own.
    """
    decorated = (
        click.argument("folder", type=click.Path(path_type=Path, file_okay=False)),
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
            "--kind",
            "asked",
            type=click.Choice(list(dict.fromkeys(kinds or rotation))),
            multiple=True,
            help="Only these; may be repeated.",
        ),
        click.option(
            "--workers", type=click.IntRange(min=1), default=2, show_default=True, help="Processes."
        ),
    )

    def command(run: Callable[..., None]) -> click.Command:
        @wraps(run)
        def found(count: int, seed: int, asked: tuple[str, ...], **others: Any) -> None:
            run(in_rotation(asked or rotation, count, seed), **others)

        for each in reversed(decorated):
            found = each(found)
        return campaign.command()(found)

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


@_of_kinds(PLANT_ROTATION)
@click.option(
    "--taken-out/--no-taken-out",
    default=True,
    show_default=True,
    help="Diagnose single effects once more without the true one in the catalogue.",
)
def plant(jobs: Sequence[Job], folder: Path, workers: int, taken_out: bool) -> None:
    """Diagnose sweeps of the published plate's 3D plant, everything stated exactly."""
    lines = run_plant(jobs, folder, taken_out=taken_out, workers=workers, progress=bar)
    click.echo(write_plant_summary(lines, folder))


@_of_kinds(PLATE_ROTATION, PLATE_KINDS)
@_exact
@_law_alone
@_shows
@click.option("--one-piece", is_flag=True, help="One segment through many resonances.")
@click.option("--without-truth", is_flag=True, help="What is hidden is not in the catalogue.")
def plates(
    jobs: Sequence[Job],
    folder: Path,
    workers: int,
    exact: bool,
    law_alone: bool,
    shows: float | None,
    one_piece: bool,
    without_truth: bool,
) -> None:
    """Diagnose ten solid plates, each known only within a careful laboratory's tolerances."""
    _refuse_beside_law_alone(law_alone, shows, without_truth)
    asked = Asked(
        diagnose=diagnosed_without_the_truth if without_truth else diagnosed,
        visible=visible_chi2,
        least=shows,
    )
    if law_alone:
        asked = Asked(identify=identified)
    lines = run_plates(jobs, folder, asked, exact=exact, one_piece=one_piece, workers=workers, progress=bar)
    click.echo(write_plate_summary(lines, folder))


@_of_kinds(BEAM_ROTATION, BEAM_KINDS)
@_exact
@_law_alone
@_shows
def beams(
    jobs: Sequence[Job], folder: Path, workers: int, exact: bool, law_alone: bool, shows: float | None
) -> None:
    """Diagnose ten solid beams, shaken or struck, known within tolerances too."""
    _refuse_beside_law_alone(law_alone, shows)
    asked = Asked(diagnose=beam_diagnosed, visible=beam_visible, least=shows)
    if law_alone:
        asked = Asked(identify=beam_identified)
    lines = run_beams(jobs, folder, asked, exact=exact, workers=workers, progress=bar)
    click.echo(write_beam_summary(lines, folder))


@_of_kinds(WEAK)
def apart(jobs: Sequence[Job], folder: Path, workers: int) -> None:
    """Diagnose solid plates with a weak effect, and measure what is proposed then, twice at most."""
    lines = run_apart(jobs, folder, workers=workers, progress=bar)
    click.echo(write_apart_summary(lines, folder))


if __name__ == "__main__":
    main(program=campaign, name="python -m campaign")
