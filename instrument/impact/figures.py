"""Figures of an impact test: time traces, FRF with half-power marks and fits, coherence, decays."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fitting.modal.frf import Motion
from instrument.impact.damping import Damping, marks
from instrument.impact.mode import Mode

_DATA, _FIT, _MARK = "#0b63a5", "#c2571a", "#5b8c2a"
_UNITS: dict[Motion, tuple[str, str]] = {
    "displacement": ("Receptance / (m/N)", "Displacement / m"),
    "velocity": ("Mobility / (m/s/N)", "Velocity / (m/s)"),
    "acceleration": ("Accelerance / (m/s²/N)", "Acceleration / (m/s²)"),
}


_BEYOND = 1.25
"""Times the highest mode: so far an FRF is drawn."""


def highest_hz(found: Damping) -> float:
    """Up to where an FRF is worth drawing; 0 where no mode was found."""
    return _BEYOND * max((m.frequency_hz for m in found.modes), default=0.0)


def damping_figures(found: Damping) -> dict[str, Figure]:
    """What there is to draw, by the names of its files."""
    drawn = {"frf.png": frf_figure(found)}
    if found.hits:
        drawn["hits.png"] = hits_figure(found)
    if any(m.fit for m in found.modes):
        drawn["modes.png"] = modes_figure(found)
    return drawn


def frf_figure(found: Damping) -> Figure:
    """|FRF| of every channel with its modes, and coherence below where there are several hits."""
    figure = Figure(figsize=(11, 5.5), layout="constrained")
    if found.coherence is None:
        axes = [figure.subplots()]
    else:
        axes = list(figure.subplots(2, 1, sharex=True, height_ratios=(3, 1)))
    highest = highest_hz(found)
    for name, frf in found.plain.items():
        axes[0].semilogy(frf.frequency_hz[1:], np.abs(frf.H[1:]), linewidth=1, label=name)
    for mode in found.modes:
        axes[0].axvline(mode.frequency_hz, color=_MARK if mode.accepted else _FIT, linewidth=0.8, alpha=0.6)
    first = next(iter(found.plain.values()))
    _label(axes[0], "Frequency response, modes marked (orange: not accepted)", "", _UNITS[first.motion][0])
    if highest > 0:
        axes[0].set_xlim(0, highest)
    if found.coherence is not None:
        for name, coherence in found.coherence.items():
            axes[1].plot(found.plain[name].frequency_hz, coherence, linewidth=0.8, label=name)
        axes[1].set_ylim(0, 1.05)
        _label(axes[1], "", "", "Coherence")
    axes[-1].set_xlabel("Frequency / Hz")
    return figure


def hits_figure(found: Damping) -> Figure:
    """Each hit's blow and its decay."""
    figure = Figure(figsize=(11, 2.3 * len(found.hits) + 0.6), layout="constrained")
    rows = figure.subplots(len(found.hits), 2, squeeze=False, width_ratios=(1, 2))
    for (blow, decay), judged in zip(rows, found.hits, strict=True):
        hit, rate = judged.hit, judged.hit.sample_rate_hz
        width = judged.pulse.stop - judged.pulse.start
        shown = slice(max(0, judged.pulse.start - 3 * width), judged.pulse.stop + 12 * width)
        t = np.arange(len(hit.force_n)) / rate
        blow.plot(1e3 * t[shown], hit.force_n[shown], ".-", color=_DATA, linewidth=1, label="force")
        _label(blow, hit.source if judged.accepted else f"{hit.source}: left out", "Time / ms", "Force / N")
        for channel in hit.responses:
            decay.plot(t, channel.samples, linewidth=0.5, label=channel.name)
        _label(decay, judged.why[:80], "Time / s", _UNITS[hit.responses[0].motion][1])
    return figure


def modes_figure(found: Damping) -> Figure:
    """About each mode: lines, rational fit and half-power marks."""
    modes = [m for m in found.modes if m.fit is not None][:12]
    columns = min(4, len(modes))
    rows = -(-len(modes) // columns)
    figure = Figure(figsize=(3.4 * columns, 2.8 * rows), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for ax, mode in zip(axes, modes, strict=False):
        _draw_mode(ax, found, mode)
    for ax in axes[len(modes) :]:
        ax.set_visible(False)
    return figure


def _draw_mode(ax: Axes, found: Damping, mode: Mode) -> None:
    if mode.fit is None:
        return
    fit, scale = mode.fit, 1.0
    lines = found.plain[mode.channel].between(fit.frequency_hz[0], fit.frequency_hz[-1])
    ax.plot(lines.frequency_hz, np.abs(lines.H) * scale, ".", color=_DATA, label="lines")
    ax.plot(fit.frequency_hz, np.abs(fit.H) * scale, "-", color=_FIT, linewidth=1, label="rational fit")
    at = marks(found.fine[mode.channel], mode)
    if at is not None:
        for f in (at[0], at[2]):
            ax.axvline(f, color=_MARK, linestyle=":", label="half power" if f == at[0] else None)
    _label(ax, f"{mode.frequency_hz:.2f} Hz, {100 * mode.damping_ratio:.3f} %", "Frequency / Hz", "|H|")


def _label(ax: Axes, title: str, x: str, y: str) -> None:
    ax.set_title(title, fontsize=9)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.grid(visible=True, alpha=0.3)
    ax.legend(fontsize=7, frameon=False)
