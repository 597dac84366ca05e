"""`viscorig sweep`: the sweep of an experiment alone."""

from pathlib import Path

import click

from instrument.cli.options import acceleration_option, file_argument, force_option, json_option
from instrument.cli.run import out_option, resume_option, run_parts


@click.command()
@file_argument("experiment")
@out_option
@resume_option
@force_option
@acceleration_option
@json_option
def sweep(
    experiment: Path, out: Path | None, resume: Path | None, insist: bool, json_path: str | None
) -> None:
    """The stepped sine of EXPERIMENT.toml, identified as it goes."""
    run_parts(experiment, out, resume, json_path, ("sweep",), insist=insist)
