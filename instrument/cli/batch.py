"""`viscorig batch`: many sessions or sweeps to one table and one page."""

from collections.abc import Sequence
from pathlib import Path

import click

from instrument.batch.asking import tasks_of
from instrument.batch.between import between_rows, marks_of
from instrument.batch.counted import Counted
from instrument.batch.no_band import without_spread
from instrument.batch.page import HTML, write_page
from instrument.batch.run import here, on_cluster, run_batch
from instrument.batch.table import CSV, WRITTEN, write_tables
from instrument.batch.taking_part import repeats_among
from instrument.cli.options import force_option, json_option
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.files.replaceable import PAGE, refuse_to_lose
from instrument.material.spread import FEWEST
from instrument.processes.other_processes import VARIABLE, wanted
from instrument.progress import bar

_FAILURES_SHOWN = 20


@click.command()
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, required=True)
@click.option(
    "--specimen",
    type=click.Path(path_type=Path),
    help="SPECIMEN.toml of every row that names none; a session has its own.",
)
@click.option(
    "--hammer",
    type=click.Path(path_type=Path),
    help="JSON of 'viscorig damping' for every row that names none.",
)
@click.option(
    "--diagnose", is_flag=True, help="Trace every residual to its effect; the law is the one after."
)
@click.option(
    "--out",
    "folder",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path(),
    help="Where batch.csv, batch.html and the journal go; the current folder otherwise.",
)
@click.option(
    "--workers",
    type=click.IntRange(1, 1024),
    help=f"Processes on this machine; otherwise as {VARIABLE} says, or as many as it has processors.",
)
@click.option(
    "--scheduler",
    metavar="ADDRESS",
    help="A Dask scheduler, as tcp://host:8786, instead of this machine (extra 'cluster'). Its workers see "
    "the files at the same paths.",
)
@force_option
@json_option
def batch(
    files: tuple[Path, ...],
    specimen: Path | None,
    hammer: Path | None,
    diagnose: bool,
    folder: Path,
    workers: int | None,
    scheduler: str | None,
    insist: bool,
    json_path: str | None,
) -> None:
    """A law for each of FILES: sessions (.h5), sweeps, or one table with the columns data and specimen.

    A table's other columns are hammer, temperature_c and material; its paths are from its own folder. A row
    that fails, or is questioned as `identify` does, says why and stops nothing; exit status 2 where all
    do. Stopped or killed, the same command goes on where it was.
    """
    out = Output(json_path)
    if scheduler is not None and workers is not None:
        raise click.UsageError("--workers and --scheduler exclude each other")
    if any(path.absolute() == (folder / CSV).absolute() for path in files):
        raise BadInput(f"{folder / CSV}: both given and to be written, expected another --out")
    tasks = tasks_of(files, specimen, hammer, diagnose=diagnose, insist=insist)
    for name, kind in {**WRITTEN, HTML: PAGE}.items():
        refuse_to_lose(folder / name, kind)
    runner = on_cluster(scheduler) if scheduler is not None else here(workers or wanted())
    with run_batch(tasks, folder, runner, bar) as rows:
        counted = Counted.of(rows)
        repeats = repeats_among(rows)
        between = between_rows(rows, repeats)
        marks = marks_of(between, repeats)
        without = without_spread(rows, repeats, len(between))
        page = write_page(rows, counted, between, without, folder)
        written = [*write_tables(rows, folder, marks), page]
        repeated = rows.repeated
    twice = [(tasks[place].data, first) for place, first in repeats.items()]
    _say(out, counted, repeated, twice)
    for one in between:
        for line in one.lines:
            out.say(line)
    for line in without if counted.done >= FEWEST else ():
        out.say(line)
    for path in written:
        out.say(f"wrote {path}")
    out.result(counted.result(repeated, written, between, twice))
    if not counted.done:
        raise BadInput(f"{folder / CSV}: every row failed, expected one that can be worked out")


def _say(out: Output, counted: Counted, repeated: int, twice: Sequence[tuple[str, str]]) -> None:
    before = f", {repeated} of them known before" if repeated else ""
    out.say(f"{counted.done} of {counted.rows} rows done{before}, {len(counted.failures)} failed")
    if counted.verdicts:
        out.say("verdicts: " + ", ".join(f"{n} {name}" for name, n in counted.verdicts.most_common()))
    for data, first in twice[:_FAILURES_SHOWN]:
        out.say(
            f"repeat, not in the spread: {data} is {first} again, by its bytes or by its law to four digits"
        )
    if len(twice) > _FAILURES_SHOWN:
        out.say(f"and {len(twice) - _FAILURES_SHOWN} more repeats, all in {CSV}")
    if counted.doubted:
        some = counted.doubted[:_FAILURES_SHOWN]
        more = f" and {len(counted.doubted) - len(some)} more" if len(counted.doubted) > len(some) else ""
        out.say(
            f"in doubt, not in the spread: {', '.join(some)}{more}: the law may be biased beyond its "
            "band, see its remarks; --diagnose looks for why"
        )
    for data, why in counted.failures[:_FAILURES_SHOWN]:
        out.say(f"failed: {data}: {why}")
    if len(counted.failures) > _FAILURES_SHOWN:
        out.say(f"and {len(counted.failures) - _FAILURES_SHOWN} more, all in {CSV}")
