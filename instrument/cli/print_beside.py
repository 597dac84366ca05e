"""Somebody's DMA beside the law found: a table of its temperatures."""

import numpy as np

from fitting.digits import tail
from instrument.cli.output import Output
from instrument.facts.beside import BesideTable
from instrument.files.dma_file import DmaTable
from instrument.material.beside import TableAtTemperature
from instrument.results.numbers import signed

_SAYS = {True: "differs", False: "agrees", None: "cannot be told"}


def print_beside(out: Output, table: DmaTable, found: list[TableAtTemperature], said: BesideTable) -> None:
    """A row a temperature."""
    what = "" if table.poisson is None else f", {table.kind} to shear with Poisson's ratio {table.poisson:g}"
    inside = f"{said.rows_in_band} of {said.rows} rows inside the band"
    if not found:
        out.say(f"with {table.path.name}{what}: {inside}, nothing to compare")
        return
    rows = []
    for one, at in zip(found, said.temperatures, strict=True):
        warm = "not stated" if np.isnan(one.temperature_c) else f"{one.temperature_c:g}"
        rows.append(
            [
                warm,
                str(at.rows),
                signed(at.storage_modulus_mean_difference_percent),
                f"{at.storage_modulus_rms_difference_percent:.2f}",
                signed(at.loss_factor_mean_difference, 4),
                f"{at.loss_factor_rms_difference:.4f}",
                tail(one.p_value, 3) if np.isfinite(one.p_value) else "-",
                _SAYS[one.differs],
            ]
        )
    out.table(
        f"With {table.path.name}{what}: {inside}; the table less the law",
        ["T / °C", "rows", "G' mean / %", "rms / %", "eta mean", "rms", "p", ""],
        rows,
    )
