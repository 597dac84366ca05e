"""`viscorig run`, `viscorig hammer`, `viscorig sweep`: an experiment on its rig, whole or in part."""

from pathlib import Path

import click

from instrument.cli.options import acceleration_option, file_argument, force_option, json_option
from instrument.cli.output import Output
from instrument.cli.print_run import print_finished, run_result
from instrument.cli.stopping import safe_stop
from instrument.cli.watching import Watcher
from instrument.files.plausible_rig import question_experiment
from instrument.progress import bar
from instrument.run.control import RunControl
from instrument.run.experiment import run_experiment
from instrument.run.part import Part
from instrument.session.configuration import read_whole_experiment

out_option = click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    help="Where a new session goes; the current folder otherwise.",
)
resume_option = click.option(
    "--resume",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="FOLDER",
    help="Carry on a run that was broken off: the steps it completed are not measured again.",
)


@click.command()
@file_argument("experiment")
@out_option
@resume_option
@force_option
@acceleration_option
@json_option
def run(experiment: Path, out: Path | None, resume: Path | None, insist: bool, json_path: str | None) -> None:
    """The whole EXPERIMENT.toml on the rig it names: hammer test, sweep, live identification, session."""
    run_parts(experiment, out, resume, json_path, ("hammer", "sweep"), insist=insist)


def run_parts(
    path: Path,
    out: Path | None,
    resume: Path | None,
    json_path: str | None,
    parts: tuple[Part, ...],
    *,
    insist: bool = False,
) -> None:
    """Run some parts of an experiment and print what they gave. Raises `click.UsageError`."""
    if out is not None and resume is not None and out.resolve() != resume.resolve().parent:
        raise click.UsageError(
            f"--out {out} with --resume: the session stays beside {resume}, expected no --out"
        )
    output = Output(json_path)
    experiment = read_whole_experiment(path)
    question_experiment(path, experiment.rig_path, experiment.specimen_path, insist=insist)
    control = RunControl()
    with safe_stop(control), Watcher() as watch:
        finished = run_experiment(
            experiment, out or Path(), parts, control=control, watch=watch, resume=resume, progress=bar
        )
    print_finished(output, finished)
    output.result(run_result(finished))
