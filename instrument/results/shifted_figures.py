"""Figures of one law over several temperatures: nomogram, wicket plot, Cole-Cole, shift factors."""

from pathlib import Path
from textwrap import fill

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fitting.numerics.chances import Z_95
from fitting.temperature.simple import story
from instrument.results.drawing import DATA, MODEL, WIDTH_IN, label, legend, legend_above, panels
from instrument.results.saved_figures import save_figures
from instrument.temperatures.shifted import Shifted

_POINTS = 40
_HEIGHT_IN = 8.0
_ROOM = 2.0
"""Times the lowest frequency, below which a temperature has no room on a line's left."""
_BESIDE_PT = 7.0
"""From a line to its temperature."""
_LINE = 95
"""Letters across a figure, in the size of its axes' names."""


def save_shifted_figures(found: Shifted, folder: Path) -> list[Path]:
    """`nomogram.png` (ISO 10112, ASTM E756) and `simplicity.png`.

    Raises `BadInput` where the folder cannot be written.
    """
    nomogram, ((ax,),) = panels(1, 1, 6.5)
    _nomogram(ax, found)
    legend_above(nomogram, ax)
    _say_standing(nomogram, found)
    figure = Figure(figsize=(WIDTH_IN, _HEIGHT_IN), layout="constrained")
    (wicket, cole), (shifts, curves) = figure.subplots(2, 2)
    _each_alone(wicket, cole, curves, found)
    _shift_factors(shifts, found)
    _say_standing(figure, found)
    return save_figures({"nomogram.png": nomogram, "simplicity.png": figure}, folder, 150)


def _standing(found: Shifted) -> str:
    """What a figure has to say of its law, where that is not simply the material's; empty where it is."""
    if found.verdict.simple is False:
        return "refused: no one law serves all these temperatures, the one drawn is not to be used"
    if not found.verdict.law_stands:
        return "not to be used: nothing explains these readings as they are"
    return f"counted in at all temperatures: {story(found.cause)}" if found.cause is not None else ""


def _say_standing(figure: Figure, found: Shifted) -> None:
    """Below the panels, whoever cuts a figure out of its folder."""
    said = _standing(found)
    if said:
        figure.supxlabel(fill(said, _LINE), fontsize=9, color="#b00020")


def _nomogram(ax: Axes, found: Shifted) -> None:
    """G' and eta over reduced frequency; the frequency on the right, read along a temperature's diagonal."""
    b, fit = found.band, found.fit
    for value, error, color, name in (
        (b.storage_modulus_pa / 1e6, b.storage_modulus_standard_error_pa / 1e6, DATA, "G' / MPa"),
        (b.loss_factor, b.loss_factor_standard_error, MODEL, "eta"),
    ):
        ax.loglog(b.frequency_hz, value, color=color, label=name)
        # In logarithms, or a wide band has no lower edge.
        factor = np.exp(Z_95 * error / value)
        ax.fill_between(
            b.frequency_hz,
            value / factor,
            value * factor,
            color=color,
            alpha=0.2,
            lw=0,
            label=f"{name}, 95 %",
        )
    _reduced(ax, found)
    label(ax, x=f"reduced frequency f $a_T$ / Hz (reference {fit.shift.reference_c:g} °C)", y="G' / MPa, eta")
    right = ax.twinx()
    f = np.array([b.frequency_hz[0], b.frequency_hz[-1]])
    low, high = min(x[0] for x in fit.bands_hz) / 3, max(x[1] for x in fit.bands_hz) * 3
    done = set()
    for T, log_a in zip(fit.shift.temperature_c.tolist(), fit.log_shift.tolist(), strict=True):
        if T in done:
            continue
        done.add(T)
        reduced = np.array([low, high]) * np.exp(log_a)
        right.loglog(reduced, [low, high], color="0.6", lw=0.8)
        # Beside the line, on the side where the frame is far.
        at = float(np.clip(0.8 * reduced[1], 1.2 * f[0], 0.8 * f[1]))
        side = 1 if at < _ROOM * f[0] else -1
        right.annotate(
            f"{T:g} °C",
            (at, at / np.exp(log_a)),
            (_BESIDE_PT * side, 0),
            textcoords="offset points",
            ha="left" if side > 0 else "right",
            va="center",
            fontsize=8,
            color="0.3",
        )
    right.set_ylim(low, high)
    ax.set_xlim(f[0], f[1])
    right.set_ylabel("frequency / Hz", fontsize=9)
    right.tick_params(labelsize=8, which="both")


def _reduced(ax: Axes, found: Shifted) -> None:
    """What each temperature's readings say by themselves, at their frequencies, shifted."""
    fit = found.fit
    for k, one in enumerate(found.alone):
        every = np.unique(one.frequency_hz)
        at = every[np.unique(np.linspace(0, len(every) - 1, _POINTS).astype(int))]
        storage, eta = one.begun.none.law.storage_and_loss(2 * np.pi * at)
        storage = storage / np.exp(fit.log_vertical[k])
        for values, color in ((storage / 1e6, DATA), (eta, MODEL)):
            name = "each temperature's own law where it was read" if (k, color) == (0, DATA) else None
            ax.plot(
                at * np.exp(fit.sweeps_log_shift[k]), values, "o", ms=3.5, mfc="none", color=color, label=name
            )


def _each_alone(wicket: Axes, cole: Axes, curves: Axes, found: Shifted) -> None:
    T = found.fit.shift.temperature_c
    span = max(float(np.ptp(T)), 1e-9)
    for k, (one, (low, high)) in enumerate(zip(found.alone, found.fit.bands_hz, strict=True)):
        at = np.geomspace(low, high, _POINTS)
        storage, eta = one.begun.none.law.storage_and_loss(2 * np.pi * at)
        storage = storage / np.exp(found.fit.log_vertical[k])
        color = colormaps["viridis"](0.9 * (T[k] - T.min()) / span)
        # Several specimens at one temperature are one line of the legend.
        name = f"{T[k]:g} °C" if T[k] not in T[:k] else None
        wicket.loglog(storage, eta, color=color, label=name)
        cole.plot(storage / 1e6, storage * eta / 1e6, color=color)
        curves.loglog(at * np.exp(found.fit.sweeps_log_shift[k]), storage, color=color)
    b = found.band
    wicket.loglog(b.storage_modulus_pa, b.loss_factor, "k--", lw=0.8, label="one law")
    cole.plot(b.storage_modulus_pa / 1e6, b.storage_modulus_pa * b.loss_factor / 1e6, "k--", lw=0.8)
    curves.loglog(b.frequency_hz, b.storage_modulus_pa, "k--", lw=0.8)
    label(wicket, x="G' / Pa", y="eta", title="wicket plot")
    label(cole, x="G' / MPa", y="G'' / MPa", title="Cole-Cole")
    label(curves, x="reduced frequency / Hz", y="G' / Pa", title="each temperature alone, shifted")
    legend(wicket)


def _shift_factors(ax: Axes, found: Shifted) -> None:
    fit = found.fit
    T, ten = fit.shift.temperature_c, np.log(10)
    ax.errorbar(T, fit.log_shift / ten, Z_95 * fit.log_shift_errors / ten, fmt="o", ms=4, capsize=3)
    wide = np.linspace(T.min(), T.max(), 100)
    ax.plot(wide, fit.shift.log_shift(fit.parameters, wide) / ten, color=MODEL, lw=0.8)
    label(ax, x="temperature / °C", y="log10 $a_T$", title=f"shift factors: {fit.shift.kind}")
