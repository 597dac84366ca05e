"""`viscorig demo`: a whole experiment on the simulated rig, then the published case from its tables."""

from pathlib import Path
from typing import Any

import click
import numpy as np

from drivers.simulated.plant.law import ZN1
from instrument.cli.demo_paper import show_paper_case
from instrument.cli.options import json_option
from instrument.cli.output import Output
from instrument.cli.print_run import print_finished, run_facts
from instrument.cli.stopping import safe_stop
from instrument.cli.watching import Watcher
from instrument.control import Control
from instrument.errors import BadInput
from instrument.experiment_run import Finished, run_experiment
from instrument.interchange.contents import contents_of
from instrument.progress import bar
from instrument.report.page import report_page
from instrument.session.configuration import read_whole_experiment
from instrument.session.storage import SessionFile
from instrument.simulated_case import write_case

_AT_HZ = (20.0, 100.0, 280.0)


@click.command()
@click.option(
    "--out",
    "folder",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path("viscorig-demo"),
    show_default=True,
    help="Where the session, its report, figures and results go.",
)
@click.option("--effect", help="Hide this physical effect in the simulated plate; none otherwise.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the rig's noise.")
@click.option("--paper/--no-paper", default=True, help="The published case too.")
@json_option
def demo(folder: Path, effect: str | None, seed: int, paper: bool, json_path: str | None) -> None:
    """Hammer test, sweep and live identification on a simulated rig; then the published ZN_1 case.

    The instruments are simulated behind their real protocols, in virtual time. The folder keeps the
    experiment's files to edit and run again with 'viscorig run'.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: {error.strerror or error}") from None
    out = Output(json_path)
    facts = _run_rig(out, folder, effect if effect != "none" else None, seed)
    out.say(f"to change it: edit {folder}/experiment.toml, then  viscorig run {folder}/experiment.toml")
    if paper:
        out.say()
        show_paper_case(out, folder)
    out.result(facts)


def _run_rig(out: Output, folder: Path, effect: str | None, seed: int) -> dict[str, Any]:
    hidden = f"hiding {effect}" if effect else "hiding nothing"
    out.say(f"The simulated rig ({hidden}): bare plate, hammer; damped plate, stepped sine at 1 g.\n")
    experiment = read_whole_experiment(write_case(folder, seed=seed, effect=effect))
    control = Control()
    with safe_stop(control), Watcher() as watch:
        finished = run_experiment(
            experiment, folder, ("hammer", "sweep"), control=control, watch=watch, progress=bar
        )
    print_finished(out, finished)
    _print_beside_plant(out, finished)
    facts = run_facts(finished)
    Output(str(folder / "run.json")).result(facts)
    with SessionFile(finished.session) as file:
        page = report_page(contents_of(file), bar)
    report = finished.session.with_suffix(".html")
    report.write_text(page, encoding="utf-8")
    out.say(f"report: {report}")
    return {**facts, "report": str(report)}


def _print_beside_plant(out: Output, finished: Finished) -> None:
    """The simulated plate has a law of its own that nothing above has seen."""
    if finished.fit is None or not finished.fit.facts_json:
        return
    law = {row["frequency_hz"]: row for row in finished.fit.facts_json["law"]}
    rows = []
    for f in (f for f in _AT_HZ if f in law):
        G = complex(ZN1.modulus(2 * np.pi * f))
        storage, loss = law[f]["storage_modulus_pa"], law[f]["loss_factor"]
        rows.append(
            [
                f"{f:g}",
                *(f"{storage / 1e6:.4f}", f"{G.real / 1e6:.4f}", f"{100 * (storage / G.real - 1):+.2f}"),
                *(f"{loss:.4f}", f"{G.imag / G.real:.4f}", f"{100 * (loss / (G.imag / G.real) - 1):+.2f}"),
            ]
        )
    columns = ["f/Hz", "G'/MPa found", "plant's", "%", "loss factor found", "plant's", "%"]
    out.table("what was found beside the simulated plate's own law", columns, rows)
