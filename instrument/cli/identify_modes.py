"""`viscorig identify` on tables of modes."""

from collections.abc import Sequence
from pathlib import Path

import click

from fitting.specimen import Specimen
from fitting.structures.modal_fit import fit_modes
from instrument.cli.output import Output
from instrument.files.modal_table import read_modal_table
from instrument.files.structure_file import read_structure
from instrument.models.remarks import remarks_on_law
from instrument.results.modal_from import modal_band, modal_from


def identify_modes(out: Output, data: Sequence[Path], specimens: Sequence[Path]) -> None:
    """One law from all tables, each with its specimen. Raises `BadInput`, `FittingError`, `UsageError`."""
    if len(specimens) not in (1, len(data)):
        raise click.UsageError(
            f"{len(specimens)} times --specimen for {len(data)} tables, expected one for each or one for all"
        )
    paths = list(specimens) if len(specimens) == len(data) else [specimens[0]] * len(data)
    read = [read_structure(path) for path in paths]
    plates = [s for s in read if isinstance(s, Specimen)]
    if plates:
        raise click.UsageError("a modal table of a plate: expected a beam or a shear pair")
    tables = [read_modal_table(path) for path in data]
    found = fit_modes(tables, [s for s in read if not isinstance(s, Specimen)])
    warnings = [
        text
        for t, s in zip(tables, read, strict=True)
        if s.core is not None
        for text in remarks_on_law(s.core.law, t.frequency_hz)
    ]
    result = modal_from(found, tables, [path.name for path in data], tuple(dict.fromkeys(warnings)))
    rows = [[n, f"{v:.5g}", f"{result.standard_errors[n]:.2g}"] for n, v in result.parameters.items()]
    out.table(f"{result.law_kind} by modes", ["parameter", "value", "standard error"], rows)
    out.say()
    out.table(
        "mode by mode",
        ["file", "mode", "f/Hz", "predicted", "loss factor", "predicted"],
        [
            [
                f"{m.file}",
                f"{m.mode}",
                *(f"{f:.5g}" for f in (m.frequency_hz, m.predicted_hz)),
                *(f"{eta:.4g}" for eta in (m.loss_factor, m.predicted_loss_factor)),
            ]
            for m in result.modes
        ],
    )
    out.say()
    band = modal_band(found, tables)
    every = range(0, len(band.frequency_hz), max(1, len(band.frequency_hz) // 6))
    out.table(
        "the law over the modes, +- one standard error (tables, tolerances)",
        ["frequency/Hz", "G'/MPa", "loss factor"],
        [
            [
                f"{band.frequency_hz[k]:.1f}",
                f"{band.storage_modulus_pa[k] / 1e6:.4f} +- "
                f"{band.storage_modulus_standard_error_pa[k] / 1e6:.4f}",
                f"{band.loss_factor[k]:.4f} +- {band.loss_factor_standard_error[k]:.4f}",
            ]
            for k in every
        ],
    )
    out.say(f"chi-square per degree of freedom {found.uncertainty.chi2_per_dof:.3g}")
    for text in result.warnings:
        out.say(f"note: {text}")
    out.result(result)
