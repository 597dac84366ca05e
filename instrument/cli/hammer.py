"""`viscorig hammer`: the hammer test of an experiment alone."""

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
def hammer(
    experiment: Path, out: Path | None, resume: Path | None, insist: bool, json_path: str | None
) -> None:
    """The bare plate's hammer test of EXPERIMENT.toml: natural frequencies and damping ratios."""
    run_parts(experiment, out, resume, json_path, ("hammer",), insist=insist)
