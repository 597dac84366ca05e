"""`viscorig modes`: complex modes of a specimen."""

from collections.abc import Sequence
from pathlib import Path

import click
import numpy as np

from fitting.dynamics.complex_modes import ModalValue
from fitting.specimen import PlateSpecimen
from fitting.structures import Beam
from fitting.structures.small_modes import along, small_modes
from instrument.cli.naming import naming_files
from instrument.cli.options import file_argument, force_option, json_option
from instrument.cli.output import Output
from instrument.files.plausible import question_specimen
from instrument.files.structure_file import read_structure
from instrument.models.specimen_modes import edge_twist_remark, specimen_modes
from instrument.progress import bar
from instrument.remarks.theory import theory_remark
from instrument.results.modes_from import modes_from


@click.command()
@file_argument("specimen")
@click.option("--count", type=click.IntRange(1, 100), default=8, show_default=True, help="How many modes.")
@force_option
@json_option
@naming_files
def modes(specimen: Path, count: int, insist: bool, json_path: str | None) -> None:
    """Natural frequencies and modal loss factors of SPECIMEN.toml.

    The core's law is taken at each mode's own frequency. Layer loss factors count, the remaining viscous
    damping does not; rigid modes of a free plate are left out.
    """
    out = Output(json_path)
    read = read_structure(specimen)
    question_specimen(specimen, insist=insist)
    law = read.core.law if read.core is not None else None
    found: Sequence[ModalValue]
    stretched: list[bool] = []
    remarks: list[str] = []
    if isinstance(read, PlateSpecimen):
        found = specimen_modes(read, count, bar)
        f = np.array([m.frequency_hz for m in found])
        remarks = [edge_twist_remark(read, count), theory_remark(read, law, f)]
    else:
        found = shapes = small_modes(read, law, count)
        stretched = along(read, shapes) if isinstance(read, Beam) else []
    rows = [[str(k + 1), f"{m.frequency_hz:.3f}", f"{m.loss_factor:.5f}"] for k, m in enumerate(found)]
    out.table("", ["mode", "frequency/Hz", "loss factor"], rows)
    result = modes_from(found, law, stretched, remarks)
    for remark in result.notes:
        out.say(f"note: {remark}")
    out.result(result)
