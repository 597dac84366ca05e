"""`python -m instrument.campaign`: how often the diagnosis is right on sweeps of the 3D plant."""

import sys
from pathlib import Path

import click

from instrument.campaign.cases import KINDS
from instrument.campaign.run import jobs_of, run_campaign, write_summary
from instrument.errors import BadInput, StoppedByUser
from instrument.progress import bar


@click.command()
@click.option("--count", type=click.IntRange(min=1), default=200, show_default=True, help="Cases.")
@click.option(
    "--seed", type=click.IntRange(min=0), default=1000, show_default=True, help="Of the first case."
)
@click.option(
    "--out", type=click.Path(path_type=Path), required=True, help="Folder; an earlier run there goes on."
)
@click.option("--kind", "kinds", type=click.Choice(KINDS), multiple=True, help="Only these; may be repeated.")
@click.option("--workers", type=click.IntRange(min=1), default=2, show_default=True, help="Processes.")
@click.option(
    "--taken-out/--no-taken-out",
    default=True,
    show_default=True,
    help="Diagnose single effects once more without the true one in the catalogue.",
)
def campaign(count: int, seed: int, out: Path, kinds: tuple[str, ...], workers: int, taken_out: bool) -> None:
    """Diagnose COUNT random cases and score the answers."""
    jobs = jobs_of(count, seed, kinds)
    lines = run_campaign(jobs, out, taken_out=taken_out, workers=workers, progress=bar)
    click.echo(write_summary(lines, out))


def main() -> None:
    """Run and exit: 0 done, 2 bad input, 130 stopped by the user."""
    try:
        campaign(prog_name="python -m instrument.campaign")
    except (BadInput, StoppedByUser) as error:
        click.echo(str(error), err=True)
        sys.exit(130 if isinstance(error, StoppedByUser) else 2)


if __name__ == "__main__":
    main()
