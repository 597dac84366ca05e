"""Every plot of this package: axes in, the same axes out, with units and a legend.

The only file here that needs matplotlib; it is imported when something is drawn.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fitting.numerics.chances import Z_95
from instrument.facts.diagnosis import PointLeft, StageName
from instrument.facts.rows import PointSetAside
from instrument.results.drawing import DATA, MARK, MODEL, TWO_STD, label, legend, mark_set_aside
from viscorig.shown import Columns

Array = NDArray[np.float64]

_STYLES = ("-", "--", ":", "-.")
_MARKERS = (("o", DATA), ("s", MODEL), ("^", MARK))


def axes_of(ax: Axes | None) -> Axes:
    """The axes given, or those of a new figure."""
    if ax is not None:
        return ax
    # Only here: it chooses the backend that a notebook shows figures with.
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained")[1]


def plot_laws(ax: Axes | None, laws: Mapping[str, Columns]) -> Axes:
    """G' in MPa on the left and the loss factor on the right over frequency, with 95 % bands.

    `laws` by name, each with the columns of the JSON's `law`.
    """
    left = axes_of(ax)
    right = left.twinx()
    sides = ((left, "storage_modulus", "_pa", 1e-6, DATA, "G'"), (right, "loss_factor", "", 1.0, MODEL, "η"))
    for (name, law), style in zip(laws.items(), _STYLES, strict=False):
        for side, key, unit, scale, color, symbol in sides:
            f, value = law["frequency_hz"], scale * law[key + unit]
            spread = Z_95 * scale * law[f"{key}_standard_error{unit}"]
            side.plot(f, value, style, color=color, label=f"{symbol} {name}".strip())
            if np.isfinite(spread).all():
                side.fill_between(f, value - spread, value + spread, color=color, alpha=0.2, linewidth=0)
    label(left, x="Frequency / Hz", y="Storage modulus G' / MPa", title="Core's law, 95 % bands")
    right.set_ylabel("Loss factor η", fontsize=9)
    (lines, names), (more_lines, more_names) = (side.get_legend_handles_labels() for side in (left, right))
    right.legend([*lines, *more_lines], [*names, *more_names], fontsize=8, frameon=False)
    return left


def plot_amplitude(ax: Axes | None, frequency_hz: Array, amplitude_m_s: Array, style: str, name: str) -> Axes:
    """Velocity amplitude over frequency. Shape (points,) each."""
    ax, order = axes_of(ax), np.argsort(frequency_hz)
    color = DATA if style == "o" else MODEL
    ax.semilogy(frequency_hz[order], amplitude_m_s[order], style, color=color, markersize=4, label=name)
    label(ax, x="Frequency / Hz", y="Velocity / (m/s)")
    legend(ax)
    return ax


def plot_set_aside(ax: Axes, aside: Sequence[PointSetAside]) -> None:
    """Velocity amplitudes that took no part in a fit."""
    f, measured = ([getattr(p, key) for p in aside] for key in ("frequency_hz", "measured_m_s"))
    mark_set_aside(ax, np.array(f), np.array(measured))


def plot_residual(
    ax: Axes | None,
    points: Sequence[PointLeft],
    titles: Mapping[StageName, str],
    aside: Sequence[PointSetAside] = (),
) -> Axes:
    """What fits leave of the amplitudes, in percent, over the noise. `titles` by the stage's key.

    Where readings were set `aside` is marked at the foot.
    """
    ax = axes_of(ax)
    points = sorted(points, key=lambda p: p.frequency_hz)
    f = np.array([p.frequency_hz for p in points])
    noise = TWO_STD * np.array([p.noise_percent for p in points], dtype=float)
    if np.isfinite(noise).all():
        ax.errorbar(f, np.zeros(len(f)), noise, fmt="none", color="#999999", label="noise, ± 2 std")
    for (stage, name), (marker, color) in zip(titles.items(), reversed(_MARKERS[:2]), strict=True):
        rest = np.array([p.stage(stage).amplitude_percent for p in points], dtype=float)
        ax.plot(f, rest, marker, color=color, markersize=4, label=name)
    ax.axhline(0, color="#888888", linewidth=0.8)
    mark_set_aside(ax, np.array([p.frequency_hz for p in aside]))
    label(ax, x="Frequency / Hz", y="Predicted less measured amplitude / %")
    legend(ax)
    return ax


def plot_ratios(ax: Axes | None, table: Columns, methods: Mapping[str, str]) -> Axes:
    """Damping ratios over frequency with one standard error. `methods`: their names by the columns' stem."""
    ax = axes_of(ax)
    for (stem, name), (marker, color) in zip(methods.items(), _MARKERS, strict=True):
        f, ratio, error = table["frequency_hz"], table[f"{stem}_ratio"], table[f"{stem}_standard_error"]
        ax.errorbar(f, 100 * ratio, 100 * error, fmt=marker, color=color, mfc="none", capsize=3, label=name)
    label(ax, x="Frequency / Hz", y="Damping ratio / % of critical")
    legend(ax)
    return ax


def plot_modes(ax: Axes | None, table: Columns) -> Axes:
    """Modal loss factors over natural frequencies."""
    ax = axes_of(ax)
    ax.stem(table["frequency_hz"], table["loss_factor"], label="modes")
    label(ax, x="Frequency / Hz", y="Modal loss factor")
    legend(ax)
    return ax
