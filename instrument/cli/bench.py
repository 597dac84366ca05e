"""`viscorig bench`: the performance table, or how often a diagnosis is right."""

from dataclasses import asdict
from functools import partial
from pathlib import Path

import click

from instrument.campaign.beams.cases import KINDS as BEAM_KINDS
from instrument.campaign.beams.judged import diagnosed as beam_diagnosed
from instrument.campaign.beams.judged import identified as beam_identified
from instrument.campaign.beams.run import beam_jobs, run_beams, write_beam_summary
from instrument.campaign.beams.visible import visible_chi2 as beam_visible
from instrument.campaign.bench import run_bench
from instrument.campaign.cases import KINDS
from instrument.campaign.plates.apart import apart_jobs, run_apart, write_apart_summary
from instrument.campaign.plates.cases import KINDS as PLATE_KINDS
from instrument.campaign.plates.judged import diagnosed, diagnosed_without_the_truth, identified
from instrument.campaign.plates.run import plate_jobs, run_plates, write_plate_summary
from instrument.campaign.plates.visible import visible_chi2
from instrument.campaign.plates.weak_effects import WEAK
from instrument.campaign.run import jobs_of, run_campaign, write_summary
from instrument.cli.options import NumberRange, json_option
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.facts.bench import BenchResult, BenchRow
from instrument.progress import bar


@click.command()
@json_option
@click.option(
    "--diagnosis",
    "folder",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="FOLDER",
    help="Instead: diagnose random sweeps of the 3D plant and score the answers. Goes on where it stopped.",
)
@click.option(
    "--plates",
    "plates_folder",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="FOLDER",
    help="Instead: the same on ten solid plates, each known only within a careful laboratory's tolerances.",
)
@click.option(
    "--beams",
    "beams_folder",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="FOLDER",
    help="Instead: the same on ten solid beams, shaken or struck.",
)
@click.option(
    "--apart",
    "apart_folder",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="FOLDER",
    help="Instead: weak effects on solid plates; what is proposed after a sweep is measured, twice at most.",
)
@click.option("--exact", is_flag=True, help="With --plates or --beams: what is stated is exact.")
@click.option("--without-truth", is_flag=True, help="With --plates: what is hidden is not in the catalogue.")
@click.option("--one-piece", is_flag=True, help="With --plates: one segment through many resonances.")
@click.option("--law-alone", is_flag=True, help="With --plates or --beams: identify, and diagnose nothing.")
@click.option(
    "--count", type=click.IntRange(min=1), default=300, show_default=True, help="Sweeps to diagnose."
)
@click.option(
    "--seed", type=click.IntRange(min=0), default=1000, show_default=True, help="Of the first of them."
)
@click.option(
    "--kind",
    "kinds",
    type=click.Choice(list(dict.fromkeys([*PLATE_KINDS, *KINDS, *WEAK, *BEAM_KINDS]))),
    multiple=True,
    help="Only these; may be repeated.",
)
@click.option(
    "--shows",
    type=NumberRange(min=0),
    help="With --plates or --beams: where what is hidden shows by less than this in chi-square, beside law, "
    "tolerances and hammer test, the sweep is drawn and not diagnosed.",
)
@click.option("--workers", type=click.IntRange(min=1), default=2, show_default=True, help="Processes.")
@click.option(
    "--taken-out/--no-taken-out",
    default=True,
    show_default=True,
    help="Diagnose single effects once more without the true one in the catalogue.",
)
def bench(
    json_path: str | None,
    folder: Path | None,
    plates_folder: Path | None,
    beams_folder: Path | None,
    apart_folder: Path | None,
    exact: bool,
    without_truth: bool,
    one_piece: bool,
    law_alone: bool,
    count: int,
    seed: int,
    kinds: tuple[str, ...],
    shows: float | None,
    workers: int,
    taken_out: bool,
) -> None:
    """Time the reduced model against direct solves and the paper's procedure, in this run on this machine."""
    out = Output(json_path)
    asked = [f for f in (folder, plates_folder, beams_folder, apart_folder) if f is not None]
    if not asked:
        _times(out)
        return
    if len(asked) > 1:
        raise BadInput(
            "--diagnosis, --plates, --beams and --apart are campaigns by themselves, expected one of them"
        )
    if shows is not None and (law_alone or plates_folder is beams_folder):
        raise BadInput("--shows is of diagnoses with --plates or --beams, expected one of them")
    if one_piece and plates_folder is None:
        raise BadInput("--one-piece is of solid plates, expected --plates beside it")
    if json_path is not None:
        raise BadInput("--json and a campaign: the outcomes are in the folder, a line of JSON each")
    of_each = ((plates_folder, PLATE_KINDS), (beams_folder, BEAM_KINDS), (apart_folder, WEAK))
    known = next((kinds for asked_for, kinds in of_each if asked_for is not None), KINDS)
    for kind in kinds:
        if kind not in known:
            raise BadInput(f"kind {kind!r} is not of this campaign, expected one of {', '.join(known)}")
    if apart_folder is not None:
        lines = run_apart(apart_jobs(count, seed, kinds), apart_folder, workers=workers, progress=bar)
        click.echo(write_apart_summary(lines, apart_folder))
        return
    if plates_folder is not None:
        jobs = plate_jobs(count, seed, kinds)
        run = partial(
            run_plates, jobs, plates_folder, exact=exact, one_piece=one_piece, workers=workers, progress=bar
        )
        judged = diagnosed_without_the_truth if without_truth else diagnosed
        found = (
            run(identify=identified) if law_alone else run(diagnose=judged, visible=visible_chi2, least=shows)
        )
        click.echo(write_plate_summary(found, plates_folder))
        return
    if beams_folder is not None:
        of_beams = partial(
            run_beams, beam_jobs(count, seed, kinds), beams_folder, exact=exact, workers=workers
        )
        alone = partial(of_beams, identify=beam_identified)
        traced = partial(of_beams, diagnose=beam_diagnosed, visible=beam_visible, least=shows)
        found = (alone if law_alone else traced)(progress=bar)
        click.echo(write_beam_summary(found, beams_folder))
        return
    assert folder is not None
    lines = run_campaign(
        jobs_of(count, seed, kinds), folder, taken_out=taken_out, workers=workers, progress=bar
    )
    click.echo(write_summary(lines, folder))


def _times(out: Output) -> None:
    rows = run_bench(bar)
    table = [
        [
            r.name,
            f"{r.seconds:.4g}",
            f"{r.ratio:,.3g}" if r.ratio is not None else "",
            r.to or "",
            f"{r.max_relative_error:.1e}" if r.max_relative_error is not None else "",
        ]
        for r in rows
    ]
    out.table("", ["what", "seconds", "times faster", "than", "max relative error"], table)
    out.result(BenchResult(rows=tuple(BenchRow(**asdict(row)) for row in rows)))
