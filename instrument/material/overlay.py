"""A law and somebody's DMA in one figure."""

from pathlib import Path

import numpy as np

from fitting.numerics.chances import Z_95
from instrument.files.dma_file import DmaTable
from instrument.material.found_law import MaterialLaw
from instrument.results.drawing import DATA, frequency_in_octaves, label, legend, panels
from instrument.results.saved_figures import save_figures

_MARKS = "osD^v<>ph*"


def save_overlay(law: MaterialLaw, table: DmaTable, folder: Path) -> Path:
    """One PNG. Raises `BadInput` where the folder cannot be written."""
    figure, ((left, right),) = panels(1, 2, 4.2)
    f = law.frequency_hz
    for ax, value, error, points, scale, y in (
        (
            left,
            law.storage_modulus_pa,
            law.storage_modulus_standard_error_pa,
            table.storage_modulus_pa,
            1e-6,
            "Storage modulus G' / MPa",
        ),
        (right, law.loss_factor, law.loss_factor_standard_error, table.loss_factor, 1.0, "Loss factor η"),
    ):
        ax.plot(f, value * scale, color=DATA, label="identified")
        if np.isfinite(error).all():
            wide = Z_95 * error
            ax.fill_between(f, (value - wide) * scale, (value + wide) * scale, color=DATA, alpha=0.2)
        for k, t in enumerate(table.temperatures()):
            rows = np.isnan(table.temperature_c) if np.isnan(t) else table.temperature_c == t
            name = table.path.name + ("" if np.isnan(t) else f", {t:g} °C")
            mark = _MARKS[k % len(_MARKS)]
            ax.plot(table.frequency_hz[rows], points[rows] * scale, mark, markersize=4, label=name)
        frequency_in_octaves(ax)
        label(ax, x="Frequency / Hz", y=y)
    legend(left)
    (path,) = save_figures({"with-dma.png": figure}, folder, 110)
    return path
