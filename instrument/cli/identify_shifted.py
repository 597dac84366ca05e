"""`viscorig identify --shift`: one law over several temperatures."""

from collections.abc import Sequence
from pathlib import Path

import click

from fitting.errors import OutsideModel
from fitting.specimen import Specimen
from fitting.temperature.shifts import Kind
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.interchange.given import Given
from instrument.models.temperatures import AtTemperature, Shifted
from instrument.models.temperatures import identify_shifted as identify_at_temperatures
from instrument.progress import bar
from instrument.results.shifted_from import shifted_from

_ROWS = 9


def identify_shifted(
    out: Output,
    data: Sequence[Path],
    given: Sequence[Given],
    kind: Kind,
    reference_c: float | None,
    figures: Path | None,
    *,
    vertical: bool,
    temperature_k: float | None = None,
) -> None:
    """Fit, print, draw; a law that is not simple is refused after its figures are saved."""
    plate = given[0].specimen
    if len(given) < 2:
        raise click.UsageError(f"--shift: {len(given)} file, expected sweeps at two temperatures or more")
    if not isinstance(plate, Specimen):
        raise BadInput(f"--shift: the specimen is a {plate.kind}, expected a plate: others have no shift yet")
    if any(g.specimen != plate for g in given):
        raise BadInput("--shift: expected sweeps of one plate, one --specimen for all")
    sweeps = []
    for path, one in zip(data, given, strict=True):
        if one.temperature_c is None:
            raise BadInput(f"{path}: no temperature, expected a column temperature_c")
        sweeps.append(AtTemperature(one.sweep, one.temperature_c, path.name))
    tested = next(((one.modes, path) for one, path in zip(given, data, strict=True) if one.modes), None)
    if tested is not None and any(one.session for one in given):
        out.say(f"the hammer test is that of {tested[1]}\n")
    modes = tested[0] if tested is not None else None
    found = identify_at_temperatures(
        sweeps,
        plate,
        kind,
        reference_c,
        bar,
        vertical=vertical,
        hammer=modes,
        temperature_k=temperature_k,
    )
    if figures is not None:
        from instrument.results.shifted_figures import save_shifted_figures

        for path in save_shifted_figures(found, figures):
            out.say(f"saved {path}")
    if found.verdict.simple is False:
        raise OutsideModel(found.verdict.words)
    result = shifted_from(found, sweeps)
    _print(out, found, sweeps)
    out.result(result)


def _print(out: Output, found: Shifted, sweeps: Sequence[AtTemperature]) -> None:
    fit, b = found.fit, found.band
    rows = [
        [n, f"{p:.5g}", f"{e:.2g}"]
        for n, p, e in zip(fit.shift.names, fit.parameters, fit.parameter_errors, strict=True)
    ]
    out.table(f"shift: {fit.shift.kind}", ["parameter", "value", "standard error"], rows)
    rows = [
        [
            one.name,
            f"{one.temperature_c:g}",
            f"{fit.log_shift[k]:+.4f}",
            f"{fit.log_shift_errors[k]:.4f}",
            f"{fit.log_vertical[k]:+.4f}",
        ]
        for k, one in enumerate(sweeps)
    ]
    out.table("shift factors", ["file", "temperature/degC", "ln a_T", "standard error", "ln b_T"], rows)
    every = max(1, len(b.frequency_hz) // _ROWS)
    rows = [
        [
            f"{b.frequency_hz[k]:.4g}",
            f"{b.storage_modulus_pa[k] / 1e6:.4f} +- {b.storage_modulus_standard_error_pa[k] / 1e6:.4f}",
            f"{b.loss_factor[k]:.4f} +- {b.loss_factor_standard_error[k]:.4f}",
        ]
        for k in range(0, len(b.frequency_hz), every)
    ]
    out.table(
        f"the law at {fit.shift.reference_c:g} degC, +- one standard error",
        ["reduced frequency/Hz", "G'/MPa", "loss factor"],
        rows,
    )
    out.say(found.verdict.words)
    for warning in found.warnings:
        out.say(f"note: {warning}")
