"""`viscorig check`: an experiment before it is run."""

from pathlib import Path

import click

from instrument.check.dry_run import all_faults, dry_run
from instrument.cli.options import file_argument, force_option, json_option
from instrument.cli.output import Output
from instrument.cli.printable import printable
from instrument.errors import BadInput
from instrument.files.plausible import question_specimen
from instrument.models.tolerance_words import tolerance_rows
from instrument.progress import bar
from instrument.session.configuration import read_whole_experiment


@click.command()
@file_argument("experiment")
@force_option
@json_option
def check(experiment: Path, insist: bool, json_path: str | None) -> None:
    """Everything wrong with EXPERIMENT.toml and the files it names; then a dry run on the model.

    Predicted response, vibrometer range, travel and time of every segment. Nothing is connected.
    """
    out = Output(json_path)
    faults = all_faults(experiment)
    if faults:
        for fault in faults:
            click.echo(printable(" ".join(fault.split())), err=True)
        raise BadInput(f"{len(faults)} fault{'s' if len(faults) > 1 else ''}, nothing can be run")
    question_specimen(read_whole_experiment(experiment).specimen_path, insist=insist)
    with bar("dry run"):
        run = dry_run(experiment)
    rows = [
        [
            f"{s.segment}",
            f"{s.low_hz:g} to {s.high_hz:g}",
            f"{s.steps}",
            f"{1e3 * s.velocity_m_s:.3g}",
            s.range_name,
            f"{1e3 * s.travel_m:.3g}",
            f"{s.seconds:.0f}",
        ]
        for s in run.segments
    ]
    columns = ["segment", "f/Hz", "steps", "velocity/(mm/s)", "range", "base travel/mm", "at most/s"]
    if rows:
        out.table("predicted", columns, rows)
    out.say("modes expected at " + ", ".join(f"{f:.4g}" for f in run.mode_hz) + " Hz")
    if run.hammer_record_s is not None:
        out.say(f"hammer: records of {run.hammer_record_s:g} s")
    if (t := run.temperature) is not None:
        near = f"{t.set_point_c:g} °C within {t.within_c:g} °C for {t.soak_s:g} s"
        out.say(f"chamber: {near}, given up after {t.most_s:g} s; its way there is not in the time below")
    out.say(f"about {run.seconds:.0f} s in all, with calibration, sentinel and hits where there are any")
    out.say("tolerances: " + ", ".join(" ".join(row) for row in tolerance_rows(run.specimen)))
    for warning in run.warnings:
        out.say(f"warning: {warning}")
    out.result(run.result)
