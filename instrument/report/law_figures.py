"""Figures of an identification: the law with its bands, and what is left of the points."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from fitting.numerics.chances import Z_95
from instrument.finding.identification import Identified
from instrument.report.fitted import ReportedFit
from instrument.report.measured import Measured
from instrument.results.drawing import (
    DATA,
    MODEL,
    TWO_STD,
    from_zero,
    in_rows,
    label,
    legend,
    legend_above,
    mark_set_aside,
    panels,
)


def law_figure(fit: Identified, name: str = "identified") -> Figure:
    """G' and eta over the measured range with 95 % bands, ticks where it was measured; `name` of the law."""
    figure, ((left, right),) = panels(1, 2, 3.9)
    b = fit.result.band
    for ax, value, error, scale, y in (
        (left, b.storage_modulus_pa, b.storage_modulus_standard_error_pa, 1e-6, "Storage modulus G' / MPa"),
        (right, b.loss_factor, b.loss_factor_standard_error, 1.0, "Loss factor η"),
    ):
        low, high = (value - Z_95 * error) * scale, (value + Z_95 * error) * scale
        if np.isfinite(error).all():
            ax.fill_between(b.frequency_hz, low, high, color=DATA, alpha=0.2, linewidth=0, label="95 % band")
        ax.plot(b.frequency_hz, value * scale, color=DATA, label=name)
        ax.plot(
            fit.sweep.frequency_hz,
            np.full(len(fit.sweep), 0.015),
            "|",
            color="#222222",
            markersize=6,
            transform=ax.get_xaxis_transform(),
            label="measured here",
        )
        if np.isfinite(error).all() and low.min() >= 0:
            from_zero(ax, high)
        label(ax, x="Frequency / Hz", y=y)
    legend(left)
    return figure


def residual_figures(segments: list[Measured], fitted: ReportedFit) -> list[Figure]:
    """Model less measurement, amplitude above phase, a column a segment; of the plate as it is stated."""
    return [_residuals(row, fitted) for row in in_rows([m for m in segments if not m.elsewhere])]


def _residuals(segments: Sequence[Measured], fitted: ReportedFit) -> Figure:
    figure, (above, below) = panels(2, len(segments), 4.4)
    for amplitude, phase, m in zip(above, below, segments, strict=True):
        f, over_base = m.frequency_hz[m.kept], m.over_base[m.kept]
        model = fitted.over_base(f)
        assert model is not None
        noise = TWO_STD * m.std[m.kept] / np.abs(over_base)
        ratio = model / over_base
        for ax, rest, band in (
            (amplitude, 100 * (np.abs(ratio) - 1), 100 * noise),
            (phase, np.degrees(np.angle(ratio)), np.degrees(noise)),
        ):
            ax.fill_between(f, -band, band, color=DATA, alpha=0.2, linewidth=0, label="± 2 std of the noise")
            ax.plot(
                f,
                rest,
                "o-",
                color=MODEL,
                markersize=3,
                linewidth=0.8,
                label="model less measured",
            )
            ax.axhline(0, color="#888888", linewidth=0.8)
            mark_set_aside(ax, m.frequency_hz[~m.kept])
        label(amplitude, title=f"Segment {m.segment}")
        label(phase, x="Frequency / Hz")
    label(above[0], y="Amplitude / %")
    label(below[0], y="Phase / degree")
    legend_above(figure, *above)
    return figure
