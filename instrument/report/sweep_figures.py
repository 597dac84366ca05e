"""Figures of a sweep: response by segment, and how well each point was measured."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fitting.arrays import Array, Complex
from instrument.facts.diagnosis import DiagnosisResult
from instrument.files.acceleration import acceleration_unit
from instrument.report.fitted import ReportedFit
from instrument.report.measured import Measured, explained, relative_noise
from instrument.results.drawing import (
    DATA,
    MARK,
    MODEL,
    SECOND,
    TWO_STD,
    from_zero,
    in_rows,
    label,
    legend,
    legend_above,
    mark_set_aside,
    panels,
)
from instrument.session.contents import Contents
from instrument.stream.derived import PointMeasured

_MM = 1e3
"""Millimetres of a metre."""


def response_figures(
    segments: list[Measured], fitted: ReportedFit, found: DiagnosisResult | None = None
) -> list[Figure]:
    """Amplitude above phase, a column a segment; with the effects that a diagnosis `found` beside it."""
    return [_response(row, fitted, found) for row in in_rows(segments)]


def _response(segments: Sequence[Measured], fitted: ReportedFit, found: DiagnosisResult | None) -> Figure:
    figure, (above, below) = panels(2, len(segments), 5.2)
    for amplitude, phase, measured in zip(above, below, segments, strict=True):
        _draw_segment(amplitude, phase, measured, fitted, explained(measured, found))
    label(above[0], y=f"|v/a| / (mm/s)/{acceleration_unit().under}")
    label(below[0], y="Phase / degree")
    legend_above(figure, *above)
    return figure


def _draw_segment(
    amplitude: Axes,
    phase: Axes,
    m: Measured,
    fitted: ReportedFit,
    after: list[tuple[Array, Complex]],
) -> None:
    f, size, scale = m.frequency_hz, np.abs(m.over_base), _MM * acceleration_unit().m_s2
    # The model is of the spot and the plate that the specimen file says.
    model = fitted.over_base(m.grid_hz) if not m.elsewhere else None
    kept, angle = m.kept, _angle(m)
    if model is not None:
        course = np.unwrap(np.angle(model))
        at = np.interp(f, m.grid_hz, course)
        # Turns are the model's: what is measured lies beside it.
        angle = at + np.angle(m.over_base * np.exp(-1j * at))
        line: dict[str, Any] = {"color": MODEL, "linewidth": 1.3, "linestyle": "-"}
        name = "model fitted"
        if after:
            name, line["linestyle"] = "model without any effect", "--"
        amplitude.plot(m.grid_hz, scale * np.abs(model), label=name, **line)
        phase.plot(m.grid_hz, np.degrees(course), **line)
    for n, (at_hz, with_effects) in enumerate(after):
        near = np.interp(at_hz, f, angle)
        turned = near + np.angle(with_effects * np.exp(-1j * near))
        line = {"color": MARK, "linewidth": 1.3, "linestyle": "-"}
        name = "" if n else "with what the diagnosis found"
        amplitude.plot(at_hz, scale * np.abs(with_effects), label=name or None, **line)
        phase.plot(at_hz, np.degrees(turned), **line)
    bars: dict[str, Any] = {"fmt": "o", "markersize": 3.5, "color": DATA, "capsize": 2, "elinewidth": 0.8}
    each = np.degrees(TWO_STD * m.std[kept] / size[kept])
    amplitude.errorbar(
        f[kept],
        scale * size[kept],
        scale * TWO_STD * m.std[kept],
        label="measured, ± 2 standard deviations",
        **bars,
    )
    phase.errorbar(f[kept], np.degrees(angle[kept]), each, **bars)
    mark_set_aside(amplitude, f[~kept], scale * size[~kept])
    mark_set_aside(phase, f[~kept], np.degrees(angle[~kept]))
    from_zero(amplitude, scale * (size if model is None else np.concatenate([size, np.abs(model)])))
    label(amplitude, title=f"Segment {m.segment}" + (f"\n{m.elsewhere}" if m.elsewhere else ""))
    label(phase, x="Frequency / Hz")


def _angle(m: Measured) -> Array:
    """Without jumps along the points that are kept, the others beside them. Shape (points,)."""
    if not m.kept.any():
        return np.angle(m.over_base)
    at = np.interp(m.frequency_hz, m.frequency_hz[m.kept], np.unwrap(np.angle(m.over_base[m.kept])))
    return np.asarray(at + np.angle(m.over_base * np.exp(-1j * at)))


def quality_figure(contents: Contents) -> Figure:
    """Noise, control error, distortion and settling time, point after point as they were measured."""
    figure, columns = panels(4, 1, 7.2)
    noise, control, distortion, settle = (row[0] for row in columns)
    points = contents.measured
    n = np.array([p.step for p in points])
    sentinel = np.array([p.purpose == "sentinel" for p in points])
    _dots(noise, n, 100 * relative_noise(points, "velocity"), DATA, "velocity")
    _dots(noise, n, 100 * relative_noise(points, "base"), SECOND, "base acceleration")
    noise.set_yscale("log")
    _dots(control, n, _all(points, "control_error_percent"), SECOND, "")
    _draw_tolerance(control, contents)
    _dots(distortion, n, _all(points, "velocity_distortion_percent"), DATA, "velocity")
    _dots(distortion, n, _all(points, "base_distortion_percent"), SECOND, "base acceleration")
    _dots(settle, n, _all(points, "settle_s"), DATA, "")
    if sentinel.any():
        settle.plot(
            n[sentinel], _all(points, "settle_s")[sentinel], "s", color=MARK, markersize=5, label="sentinel"
        )
    from_zero(settle, _all(points, "settle_s"))
    for ax, y in zip(
        (noise, control, distortion, settle),
        ("Noise / %", "Control error / %", "Distortion / %", "Settling / s"),
        strict=True,
    ):
        label(ax, y=y)
        _segment_edges(ax, points)
        legend(ax)
    label(settle, x="Step")
    return figure


def _dots(ax: Axes, x: Array, y: Array, colour: str, name: str) -> None:
    ax.plot(x, y, ".", color=colour, markersize=5, label=name or None)


def _draw_tolerance(ax: Axes, contents: Contents) -> None:
    table = contents.configuration.experiment.sweep
    if table is not None:
        tolerance = table.control.tolerance_percent
        for side in (-tolerance, tolerance):
            ax.axhline(
                side, color=MODEL, linewidth=0.8, label=f"tolerance {tolerance:g} %" if side > 0 else None
            )


def _segment_edges(ax: Axes, points: list[PointMeasured]) -> None:
    """A line where another segment or sweep begins."""
    for before, after in pairwise(points):
        if (before.segment, before.sweep) != (after.segment, after.sweep):
            ax.axvline((before.step + after.step) / 2, color="#888888", linewidth=0.8, linestyle=":")


def _all(points: list[PointMeasured], name: str) -> Array:
    return np.array([getattr(p, name) for p in points], dtype=float)
