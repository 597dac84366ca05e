"""`viscorig predict`: the response at the pickup."""

from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from instrument.cli.options import Frequencies, file_argument, json_option
from instrument.cli.output import Output
from instrument.files.specimen_file import read_specimen
from instrument.models import Models
from instrument.progress import bar


@click.command()
@file_argument("specimen")
@click.option(
    "--frequencies",
    type=Frequencies(),
    required=True,
    help="In Hz: A:B:STEP (B included), or a list F1,F2,...",
)
@click.option(
    "--real-modes", is_flag=True, help="The paper's uncoupled real modes instead of the full equation."
)
@json_option
def predict(
    specimen: Path, frequencies: NDArray[np.float64], real_modes: bool, json_path: str | None
) -> None:
    """Velocity at the pickup of SPECIMEN.toml under its base acceleration, as phasors and amplitudes."""
    out = Output(json_path)
    read = read_specimen(specimen)
    models = Models.of(read, frequencies, bar)
    law = read.core.law if read.core is not None else None
    v = models.predict(law, frequencies, real_modes=real_modes)
    points = [
        {
            "frequency_hz": float(f),
            "velocity_re_m_s": float(z.real),
            "velocity_im_m_s": float(z.imag),
            "velocity_m_s": float(abs(z)),
        }
        for f, z in zip(frequencies, v, strict=True)
    ]
    rows = [
        [f"{f:g}", f"{abs(z):.6g}", f"{z.real:.6g}", f"{z.imag:.6g}"]
        for f, z in zip(frequencies, v, strict=True)
    ]
    title = f"{read.reads} velocity at {read.base_acceleration_m_s2:g} m/s^2 base acceleration"
    out.table(title, ["frequency/Hz", "amplitude/(m/s)", "real/(m/s)", "imaginary/(m/s)"], rows)
    out.result({"points": points})
