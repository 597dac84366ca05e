"""`viscorig predict`: the response at the pickup."""

from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from fitting.identification.bare_plate import fit_bare_plate, with_bare_plate
from fitting.specimen import PlateSpecimen, StatedSpecimen
from fitting.stated.layers import Core
from fitting.structures import Beam, ShearPair
from fitting.structures.small_modes import small_velocity
from instrument.cli.naming import naming_files
from instrument.cli.options import Frequencies, acceleration_option, file_argument, force_option, json_option
from instrument.cli.output import Output
from instrument.facts.prediction import PredictionResult
from instrument.files.acceleration import acceleration_unit
from instrument.files.hammer_file import read_hammer
from instrument.files.plausible import question_specimen
from instrument.files.structure_file import read_structure
from instrument.models.specimen_models import Models
from instrument.progress import bar
from instrument.remarks.theory import theory_remark
from instrument.results.fit_file import read_fit
from instrument.results.fitted_response import fitted_response
from instrument.results.prediction_from import of_spots, prediction_from, prediction_from_fit


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
@click.option(
    "--fit",
    type=click.Path(path_type=Path),
    help="JSON of 'viscorig identify': its law and plate as found there, with the response's errors.",
)
@click.option(
    "--hammer",
    type=click.Path(path_type=Path),
    help="JSON of 'viscorig damping': stiffness and ratios as the bare plate's hammer test has them.",
)
@acceleration_option
@force_option
@json_option
@naming_files
def predict(
    specimen: Path,
    frequencies: NDArray[np.float64],
    real_modes: bool,
    fit: Path | None,
    hammer: Path | None,
    insist: bool,
    json_path: str | None,
) -> None:
    """Velocity at the pickup of SPECIMEN.toml under its base acceleration, as phasors and amplitudes."""
    if real_modes and fit is not None:
        raise click.UsageError("--real-modes and --fit: expected one of them")
    out = Output(json_path)
    read = read_structure(specimen)
    question_specimen(specimen, insist=insist)
    if not isinstance(read, PlateSpecimen):
        of_plates = {"--real-modes": real_modes, "--hammer": hammer is not None}
        asked = ", ".join(option for option, given in of_plates.items() if given)
        if asked:
            raise click.UsageError(f"{asked} with a {read.kind}: expected a plate")
        if fit is not None:
            known = read_fit(fit)
            found = fitted_response(read, known, frequencies)
            _show(out, read, prediction_from_fit(found, known.outside(frequencies)))
            return
        _show(out, read, _of_small(read, frequencies))
        return
    if hammer is not None:
        read = with_bare_plate(read, fit_bare_plate(read, *read_hammer(hammer)))
    law = read.core.law if read.core is not None else None
    if fit is not None:
        if read.further_pickups_m:
            raise click.UsageError("--fit with several pickups: expected one")
        known = read_fit(fit)
        found = fitted_response(read, known, frequencies, bar)
        law = known.law(law) if law is not None else None
        remarks = (known.outside(frequencies), theory_remark(read, law, frequencies))
        result = prediction_from_fit(found, *remarks)
    else:
        remarks = (_outside(read.core, frequencies), theory_remark(read, law, frequencies))
        spots = [
            Models.of(read.at_pickup(k), frequencies, bar).predict(law, frequencies, real_modes=real_modes)
            for k in range(max(1, len(read.pickups_m)))
        ]
        result = of_spots([prediction_from(frequencies, v, *remarks) for v in spots])
    _show(out, read, result)


_ERRORS = {
    "+-/(m/s)": ("velocity_standard_error_m_s", 1.0),
    "+-/deg": ("phase_standard_error_rad", 180 / np.pi),
}
"""Columns of standard errors, of amplitude and phase, where a fit is predicted with."""


def _of_small(read: Beam | ShearPair, frequencies: NDArray[np.float64]) -> PredictionResult:
    spots: list[Beam | ShearPair] = [read]
    if isinstance(read, Beam) and read.further_pickups_m:
        spots = [read.at_pickup(k) for k in range(len(read.pickups_m))]
    outside = _outside(read.core, frequencies)
    return of_spots(
        [prediction_from(frequencies, small_velocity(one, frequencies), outside) for one in spots]
    )


def _outside(core: Core | None, frequencies: NDArray[np.float64]) -> str:
    return core.law.outside(frequencies) if core is not None else ""


def _show(out: Output, read: StatedSpecimen, result: PredictionResult) -> None:
    known = [] if np.isnan(result.points[0].velocity_standard_error_m_s) else list(_ERRORS)
    several = [] if result.points[0].pickup is None else ["pickup"]
    rows = [
        [
            *(str(p.pickup) for _ in several),
            f"{p.frequency_hz:g}",
            *(f"{v:.6g}" for v in (p.velocity_m_s, p.velocity_re_m_s, p.velocity_im_m_s)),
            *(f"{getattr(p, key) * scale:.2g}" for key, scale in (_ERRORS[name] for name in known)),
        ]
        for p in result.points
    ]
    per = acceleration_unit().typed(read.drive_amplitude, ".6g") + " base acceleration"
    title = f"{read.reads} velocity at {per}" if read.drive == "base" else "velocity for a force of 1 N"
    columns = ["frequency/Hz", "amplitude/(m/s)", "real/(m/s)", "imaginary/(m/s)"]
    out.table(title, [*several, *columns, *known], rows)
    for remark in result.notes:
        out.say(f"note: {remark}")
    out.result(result)
