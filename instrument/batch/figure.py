"""The laws of all rows in one figure."""

from collections.abc import Iterable
from itertools import islice

import numpy as np
from matplotlib.figure import Figure

from fitting.numerics.chances import Z_95
from instrument.batch.run import BatchRow
from instrument.results.drawing import DATA, frequency_in_octaves, label, panels

MOST = 400
"""Laws drawn; of more, every second, third, ... one."""
_LINES_APART = 12
"""So many lines can be told apart: each in a colour of its own, and named."""


def laws_figure(rows: Iterable[BatchRow], count: int) -> Figure:
    """G' and eta of `count` rows that have a law, with their 95 % bands."""
    figure, ((left, right),) = panels(1, 2, 4.6)
    some = islice((row for row in rows if _law(row)), 0, None, 1 + (count - 1) // MOST if count else 1)
    drawn = min(count, MOST)
    few = count <= _LINES_APART
    faint = max(0.02, 0.3 / max(drawn, 1)) if not few else 0.15
    for row in some:
        law = {key: np.array(values, dtype=float) for key, values in _law(row).items()}
        f = law["frequency_hz"]
        colour = None if few else DATA
        for ax, key, error, scale in (
            (left, "storage_modulus_pa", "storage_modulus_standard_error_pa", 1e-6),
            (right, "loss_factor", "loss_factor_standard_error", 1.0),
        ):
            value, wide = law[key] * scale, Z_95 * law[error] * scale
            name = row.task.data.rsplit("/", 1)[-1] if few else None
            (line,) = ax.plot(f, value, color=colour, linewidth=1.2 if few else 0.6, label=name)
            line.set_alpha(1.0 if few else max(0.15, 4 / drawn))
            line.set_rasterized(not few)
            if np.isfinite(wide).all():
                band = ax.fill_between(
                    f, value - wide, value + wide, color=line.get_color(), alpha=faint, linewidth=0
                )
                band.set_rasterized(not few)
    for ax, y in ((left, "Storage modulus G' / MPa"), (right, "Loss factor η")):
        label(ax, x="Frequency / Hz", y=y)
        if count:
            frequency_in_octaves(ax)
        ax.set_ylim(bottom=0)
    if few and count:
        left.legend(fontsize=7, frameon=False)
    return figure


def _law(row: BatchRow) -> dict[str, list[float]]:
    law: dict[str, list[float]] = row.outcome.get("law") or {}
    return law
