"""`viscorig doctor`: the installation, and the instruments it can reach."""

from pathlib import Path

import click

from instrument.check.installation import look_at_installation
from instrument.cli.options import json_option
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.facts.doctor import DoctorResult, Finding
from instrument.files.plausible_rig import rig_doubts
from instrument.files.sensor_file import read_rig
from instrument.files.toml import read_tables
from instrument.progress import bar
from instrument.run.visit import visit

_SIGNS = {"good": "ok", "remark": "note", "fault": "FAULT"}


@click.command()
@click.argument("rig", type=click.Path(path_type=Path), required=False)
@json_option
def doctor(rig: Path | None, json_path: str | None) -> None:
    """Whether the installation is in order and, with RIG.toml, whether its instruments answer.

    Instruments are asked who they are and how they stand; nothing is started, no range or drive is set. Exit
    status 2 where something has to be mended.
    """
    out = Output(json_path)
    document = read_rig(rig) if rig is not None else None
    findings: list[Finding] = []
    with bar("looking"):
        findings += look_at_installation()
        if document is not None and rig is not None:
            findings += (_doubted(doubt) for doubt in rig_doubts(read_tables(rig)))
            findings += visit(document)
    for group in dict.fromkeys(found.group for found in findings):
        out.say()
        out.say(group)
        for found in findings:
            if found.group == group:
                out.say(f"  {_SIGNS[found.state]:6s}{found.name:20s} {found.found}")
                if found.cure:
                    out.say(f"{'':29s}cure: {found.cure}")
    faults = [found for found in findings if found.state == "fault"]
    out.result(DoctorResult(healthy=not faults, findings=tuple(findings)))
    if faults:
        first = faults[0]
        raise BadInput(f"{len(faults)} to be mended, first {first.name}: {first.found}")


def _doubted(doubt: str) -> Finding:
    """A number that `check` and a run refuse unless somebody insists."""
    cure = "correct it; where it is so, check and run take --force"
    return Finding(group="rig", name="its file", state="remark", found=doubt, cure=cure)
