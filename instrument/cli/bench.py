"""`viscorig bench`: the performance table, or how often a diagnosis is right."""

from pathlib import Path

import click

from instrument.bench import run_bench
from instrument.campaign.cases import KINDS
from instrument.campaign.run import jobs_of, run_campaign, write_summary
from instrument.cli.options import json_option
from instrument.cli.output import Output
from instrument.errors import BadInput
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
    "--count", type=click.IntRange(min=1), default=300, show_default=True, help="Sweeps to diagnose."
)
@click.option(
    "--seed", type=click.IntRange(min=0), default=1000, show_default=True, help="Of the first of them."
)
@click.option("--kind", "kinds", type=click.Choice(KINDS), multiple=True, help="Only these; may be repeated.")
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
    count: int,
    seed: int,
    kinds: tuple[str, ...],
    workers: int,
    taken_out: bool,
) -> None:
    """Time the reduced model against direct solves and the paper's procedure, in this run on this machine."""
    out = Output(json_path)
    if folder is None:
        _times(out)
        return
    if json_path is not None:
        raise BadInput("--json and --diagnosis: the outcomes are in the folder, a line of JSON each")
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
    out.result({"rows": [r.__dict__ for r in rows]})
