"""`viscorig demo`: a whole experiment on the simulated rig, then the published case from its tables."""

import shlex
from pathlib import Path

import click
import numpy as np

from drivers.simulated.plant.law import ZN1
from fitting.identification.quoted import REFERENCE_FREQUENCIES_HZ
from instrument.cli.demo_paper import show_paper_case
from instrument.cli.options import json_option
from instrument.cli.output import Output
from instrument.cli.print_run import print_finished, run_result
from instrument.cli.stopping import safe_stop
from instrument.cli.watching import Watcher
from instrument.errors import BadInput, system_words
from instrument.facts.run import RunResult
from instrument.progress import bar
from instrument.report.page import report_of
from instrument.results.diagnosis_words import law_at, with_verdict
from instrument.run.control import RunControl
from instrument.run.experiment import Finished, run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.simulated_case import DEFAULT_EFFECT, chosen_effect, refuse_edited, write_case


@click.command()
@click.option(
    "--out",
    "folder",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path("viscorig-demo"),
    show_default=True,
    help="Where the session, its report, figures and results go.",
)
@click.option(
    "--effect",
    metavar="NAME",
    default=DEFAULT_EFFECT,
    show_default=True,
    help="Hide this physical effect in the simulated rig; 'none', or 'random' for one the seed picks.",
)
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the rig's noise.")
@click.option("--paper/--no-paper", default=True, help="The published case too.")
@json_option
def demo(folder: Path, effect: str, seed: int, paper: bool, json_path: str | None) -> None:
    """A whole experiment on a simulated rig, and the published ZN_1 case.

    Hammer test, sweep, live identification, diagnosis and report. The plate has an effect that the model is
    not told of. The instruments are simulated behind their real protocols, in virtual time. The folder keeps
    the experiment's files to edit and run again with 'viscorig run'.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: {system_words(error)}") from None
    out = Output(json_path)
    result = _run_rig(out, folder, chosen_effect(effect, seed), seed)
    out.say(_to_change_it(folder))
    if paper:
        out.say()
        show_paper_case(out, folder)
    out.result(result)


def _to_change_it(folder: Path) -> str:
    named = shlex.quote(str(folder / "experiment.toml"))
    return f"to change it: edit {named}, then  viscorig run {named}"


def _run_rig(out: Output, folder: Path, effect: str | None, seed: int) -> RunResult:
    refuse_edited(folder)
    out.say("The simulated rig: bare plate, hammer; damped plate, stepped sine at 1 g.")
    out.say(f"Hidden in it: {effect or 'nothing'}. The model is not told.\n")
    experiment = read_whole_experiment(write_case(folder, seed=seed, effect=effect))
    control = RunControl()
    with safe_stop(control), Watcher() as watch:
        finished = run_experiment(
            experiment, folder, ("hammer", "sweep"), control=control, watch=watch, progress=bar
        )
    print_finished(out, finished)
    _print_beside_plant(out, finished)
    if finished.diagnosis is not None and finished.diagnosis.result is not None:
        from instrument.results.diagnosis_figures import save_diagnosis_figures

        for path in save_diagnosis_figures(finished.diagnosis.result, folder):
            out.say(f"saved {path}")
    result = run_result(finished)
    Output(str(folder / "run.json")).result(result)
    with SessionFile(finished.session) as file:
        page = report_of(contents_of(file), bar).html()
    report = finished.session.with_suffix(".html")
    report.write_text(page, encoding="utf-8")
    out.say(f"report: {report}")
    return result.but(report=str(report))


def _print_beside_plant(out: Output, finished: Finished) -> None:
    """The simulated plate has a law of its own that nothing above has seen."""
    found = finished.diagnosis.result if finished.diagnosis is not None else None
    if found is None:
        return
    rows = []
    for f in REFERENCE_FREQUENCIES_HZ:
        known = [row for stage in found.stages if (row := law_at(stage.law, f)) is not None]
        if len(known) < len(found.stages):
            continue
        G = complex(ZN1.modulus(2 * np.pi * f))
        eta = G.imag / G.real
        rows.append(
            [
                f"{f:g}",
                *(_beside(row.storage_modulus_pa, G.real, 1e-6) for row in known),
                f"{G.real / 1e6:.4f}",
                *(_beside(row.loss_factor, eta, 1.0) for row in known),
                f"{eta:.4f}",
            ]
        )
    columns = ["f/Hz", "G'/MPa before", "after", "plant's", "loss factor before", "after", "plant's"]
    title = with_verdict("the core: what was found beside the simulated plate's own law", found)
    out.table(title, columns, rows)


def _beside(value: float, true: float, scale: float) -> str:
    return f"{scale * value:.4f} ({100 * (value / true - 1):+.2f} %)"
