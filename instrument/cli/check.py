"""`viscorig check`: an experiment before it is run."""

from pathlib import Path

import click

from fitting.gravity import PUBLISHED_G_M_S2
from instrument.check.dry_run import all_faults, dry_run
from instrument.cli.options import acceleration_option, file_argument, force_option, json_option
from instrument.cli.output import Output
from instrument.cli.printable import printable
from instrument.errors import BadInput
from instrument.facts.check import CheckResult
from instrument.files.acceleration import acceleration_unit
from instrument.files.plausible_rig import question_experiment
from instrument.progress import bar
from instrument.remarks.tolerance_words import tolerance_rows
from instrument.session.configuration import Experiment, read_whole_experiment
from instrument.session.setup import sweep_settings


@click.command()
@file_argument("experiment")
@acceleration_option
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
        out.result(CheckResult(segments=(), modes_hz=(), seconds=0.0, faults=tuple(faults)))
        raise BadInput(f"{len(faults)} fault{'s' if len(faults) > 1 else ''}, nothing can be run")
    whole = read_whole_experiment(experiment)
    question_experiment(whole.path, whole.rig_path, whole.specimen_path, insist=insist)
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
    columns = ["segment", "f/Hz", "steps", "velocity/(mm/s)", "range", "base travel/mm", "about/s"]
    if rows:
        out.table("predicted", columns, rows)
        out.say(_level(whole))
    out.say("modes expected at about " + ", ".join(f"{f:.4g}" for f in run.mode_hz) + " Hz")
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


def _level(experiment: Experiment) -> str:
    """Of the sweep's base, beside its limit."""
    sweep, shown = experiment.document.sweep, acceleration_unit()
    assert sweep is not None
    limit = sweep_settings(experiment.document, experiment.rig).limits.base_m_s2
    return f"base at {shown.typed(sweep.level_g * PUBLISHED_G_M_S2)}, its limit {shown.typed(limit)}"
