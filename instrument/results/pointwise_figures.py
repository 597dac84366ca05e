"""Figure of a core found band by band, over the law that was fitted to all of it."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fitting.arrays import Array
from fitting.identification.kramers_kronig import FIRST_ORDER, KramersKronig
from fitting.identification.pointwise import PointwiseLaw
from fitting.identification.result import LawBand
from fitting.numerics.chances import Z_95
from instrument.finding.pointwise import Pointwise
from instrument.results.drawing import (
    DATA,
    MARK,
    MODEL,
    frequency_in_octaves,
    label,
    legend_above,
    panels,
)
from instrument.results.saved_figures import save_figures

_FAINT = 0.3
_ROOM = 1.6
"""Of the law's own height: error bars beyond it are cut."""
_NOT_HERE = "#888888"


def save_pointwise_figure(found: Pointwise, band: LawBand, folder: Path) -> Path:
    """One PNG. Raises `BadInput` where the folder cannot be written."""
    drawn = {"pointwise-law.png": pointwise_figure(found.law, band, found.causal)}
    (path,) = save_figures(drawn, folder, 110)
    return path


def pointwise_figure(found: PointwiseLaw, band: LawBand, causal: KramersKronig | None = None) -> Figure:
    """G' and eta with 95 % bars over the law and its 95 % band; faint where known to worse than 10 %."""
    figure, ((left, right),) = panels(1, 2, 4.2)
    known = found.known()
    _law(left, band, band.storage_modulus_pa, band.storage_modulus_standard_error_pa, 1e-6)
    _law(right, band, band.loss_factor, band.loss_factor_standard_error, 1.0)
    if causal is not None:
        f = np.geomspace(causal.frequency_hz.min(), causal.frequency_hz.max(), 200)
        G = causal.modulus(2 * np.pi * f)
        name = "nearest causal core" if causal.consistent else "nearest causal core (refuted)"
        left.plot(f, G.real / 1e6, "--", color=MARK, linewidth=1.3, zorder=4, label=name)
        right.plot(f, G.imag / G.real, "--", color=MARK, linewidth=1.3, zorder=4, label=name)
    _points(left, known, known.storage_modulus_pa, known.storage_modulus_standard_error_pa, 1e-6)
    _points(right, known, known.loss_factor, known.loss_factor_standard_error, 1.0)
    for ax, y in ((left, "Storage modulus G' / MPa"), (right, "Loss factor η")):
        _not_determined(ax, found)
        frequency_in_octaves(ax)
        label(ax, x="Frequency / Hz", y=y)
    legend_above(figure, left)
    return figure


def _law(ax: Axes, band: LawBand, value: Array, error: Array, scale: float) -> None:
    low, high = (value - Z_95 * error) * scale, (value + Z_95 * error) * scale
    if np.isfinite(error).all():
        ax.fill_between(
            band.frequency_hz, low, high, color=DATA, alpha=0.2, linewidth=0, label="95 % band of the law"
        )
    ax.plot(band.frequency_hz, value * scale, color=DATA, zorder=4, label="fitted law")
    highest = np.nanmax(np.where(np.isfinite(high), high, value * scale))
    ax.set_ylim(0, 1.08 * float(highest))


def _points(ax: Axes, known: PointwiseLaw, value: Array, error: Array, scale: float) -> None:
    """Bars in front of the law, those that hardly know anything behind it."""
    well = known.relative_error <= FIRST_ORDER
    for which, alpha, name in ((~well, _FAINT, None), (well, 1.0, "band by band, 95 %")):
        ax.errorbar(
            known.frequency_hz[which],
            value[which] * scale,
            Z_95 * error[which] * scale,
            fmt="o",
            color=MODEL,
            alpha=alpha,
            markersize=3,
            elinewidth=0.9,
            capsize=0,
            zorder=3 if alpha == 1 else 1.5,
            label=name,
        )
    if not well.any():
        return
    value, bar = value[well] * scale, Z_95 * error[well] * scale
    top = ax.get_ylim()[1]
    # Whole bars where there is room, every value in any case.
    highest = max(float(value.max()), min(float((value + bar).max()), _ROOM * top))
    lowest = max(float((value - bar).min()), -0.3 * top)
    ax.set_ylim(1.05 * min(0, lowest, float(value.min())), max(top, 1.05 * highest))


def _not_determined(ax: Axes, found: PointwiseLaw) -> None:
    """Ticks at the foot where the sweep says nothing."""
    silent = found.frequency_hz[~found.determined]
    if len(silent):
        ax.plot(
            silent,
            np.full(len(silent), 0.015),
            "|",
            color=_NOT_HERE,
            markersize=6,
            transform=ax.get_xaxis_transform(),
            label="not determined here",
        )
