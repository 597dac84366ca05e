"""The paper's figures redrawn from what was computed here. No figure knows how its numbers were found."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fitting.arrays import Array
from fitting.identification.result import LawBand
from fitting.numerics.chances import Z_95
from fitting.specimen import PlateSpecimen
from instrument.files.specimen_file import read_specimen
from instrument.models.specimen_models import Models
from instrument.paper_case import TABLE_4, case_file
from instrument.paper_case.demo import PaperRun
from instrument.progress import Progress, quiet
from instrument.results.saved_figures import save_figures as saved_figures

_DIRECT, _SECOND, _PRINTED, _MEASURED = "#0b63a5", "#c2571a", "#5b8c2a", "#222222"
_RESULT = "#555555"
_TITLES = ("First resonance region", "Third resonance region", "Fifth resonance region")


def save_figures(run: PaperRun, folder: Path, progress: Progress = quiet) -> list[Path]:
    """Fig. 6, 9 and 10 as PNG."""
    drawn = {
        "fig06-two-dampings.png": figure_6(progress),
        "fig09-response.png": figure_9(run, progress),
        "fig10-material.png": figure_10(run),
    }
    return saved_figures(drawn, folder, 130)


def figure_6(progress: Progress = quiet) -> Figure:
    """The ISD-112 plate to 600 Hz with the core's damping alone and with the viscous damping beside it."""
    specimen = read_specimen(case_file("isd112.toml"))
    # From 5 Hz: the printed law is not meant for less.
    f = np.unique(np.concatenate([np.arange(5.0, 600.25, 0.5), np.arange(15.0, 22.0, 0.05)]))
    figure = Figure(figsize=(11, 4.4), layout="constrained")
    whole, near = figure.subplots(1, 2, width_ratios=(2, 1))
    for ratios, label, color, style in (
        ((), "core damping alone", _SECOND, "--"),
        (specimen.modal_ratios, "core and viscous damping", _DIRECT, "-"),
    ):
        v = _amplitude(replace(specimen, modal_ratios=ratios), f, progress)
        whole.semilogy(f, v, style, color=color, label=label, linewidth=1.4)
        first = (f > 15) & (f < 22)
        near.plot(f[first], v[first], style, color=color, label=label, linewidth=1.4)
    whole.set_xlim(0, 600)
    near.set_ylim(bottom=0)
    _label(whole, "5 to 600 Hz", "Frequency / Hz", "Velocity / (m/s)")
    _label(near, "First resonance", "Frequency / Hz", "Velocity / (m/s)")
    figure.suptitle("Plate with ISD-112 core at (60, 60) mm, 1 g base excitation")
    return figure


def figure_9(run: PaperRun, progress: Progress = quiet) -> Figure:
    """Measured points and fitted responses around the three resonances."""
    figure = Figure(figsize=(12, 4.2), layout="constrained")
    models = Models.of(run.specimen, run.sweep.frequency_hz, progress)
    for ax, number, title in zip(figure.subplots(1, 3), np.unique(run.sweep.segment), _TITLES, strict=True):
        inside = run.sweep.segment == number
        low, high = run.sweep.frequency_hz[inside].min(), run.sweep.frequency_hz[inside].max()
        margin = 0.35 * (high - low)
        f = np.linspace(low - margin, high + margin, 161)
        for law, real, label, color, style in (
            (run.direct.result.law, False, "direct fit", _DIRECT, "-"),
            (run.paper.result.law, True, "paper's method", _SECOND, "--"),
            (TABLE_4, True, "Table 4's law, real modes", _PRINTED, ":"),
        ):
            v = np.abs(models.predict(law, f, real_modes=real))
            ax.plot(f, v, style, color=color, label=label, linewidth=1.5)
        ax.plot(
            run.sweep.frequency_hz[inside],
            run.direct.result.measured_m_s[inside],
            "o",
            color=_MEASURED,
            label="measured (Table 5)",
        )
        ax.set_ylim(bottom=0)
        _label(ax, title, "Frequency / Hz", "Velocity / (m/s)")
    figure.suptitle("ZN_1 plate at (60, 60) mm, 1 g base excitation")
    return figure


def figure_10(run: PaperRun) -> Figure:
    """G' and eta with and without the viscous damping in the model, in the 95 % band of the result.

    The band is that over all explanations of the diagnosis: a fit alone knows of none.
    """
    figure = Figure(figsize=(11, 4.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    _draw_band(left, right, run.diagnosis.result.after.band, "result, after the diagnosis", _RESULT)
    for found, label, color, style in (
        (run.direct, "both dampings", _DIRECT, "--"),
        (run.undamped, "core damping alone", _SECOND, "-."),
    ):
        b = found.result.band
        left.plot(b.frequency_hz, b.storage_modulus_pa / 1e6, style, color=color, label=label)
        right.plot(b.frequency_hz, b.loss_factor, style, color=color, label=label)
    f = run.direct.result.band.frequency_hz
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * f)
    left.plot(f, G / 1e6, ":", color=_PRINTED, label="Table 4")
    right.plot(f, eta, ":", color=_PRINTED, label="Table 4")
    for f_m in run.sweep.frequency_hz:
        for ax in (left, right):
            ax.axvline(f_m, ymax=0.03, color=_MEASURED, linewidth=1)
    _label(left, "Storage modulus", "Frequency / Hz", "G' / MPa")
    _label(right, "Loss factor", "Frequency / Hz", "Loss factor")
    figure.suptitle("ZN_1 from Table 5: the result with its 95 % band; ticks at the measured frequencies")
    return figure


def _amplitude(specimen: PlateSpecimen, f: Array, progress: Progress) -> Array:
    law = specimen.core.law if specimen.core is not None else None
    return np.abs(Models.of(specimen, f, progress).predict(law, f))


def _draw_band(left: Axes, right: Axes, b: LawBand, label: str, color: str) -> None:
    for ax, value, error, scale in (
        (left, b.storage_modulus_pa, b.storage_modulus_standard_error_pa, 1e-6),
        (right, b.loss_factor, b.loss_factor_standard_error, 1.0),
    ):
        ax.plot(b.frequency_hz, value * scale, color=color, label=label)
        low, high = (value - Z_95 * error) * scale, (value + Z_95 * error) * scale
        ax.fill_between(b.frequency_hz, low, high, color=color, alpha=0.18, linewidth=0)


def _label(ax: Axes, title: str, x: str, y: str) -> None:
    ax.set_title(title, fontsize=10)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.grid(visible=True, alpha=0.3)
    ax.legend(fontsize=8, frameon=False)
