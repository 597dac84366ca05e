"""The vibrometer against the accelerometer, in place: gain and delay of each range."""

import numpy as np
from matplotlib.figure import Figure

from instrument.report.blocks import Block, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.results.drawing import DATA, MODEL, SECOND, label, legend_above, panels
from instrument.results.numbers import with_error
from instrument.session.contents import Contents
from instrument.stream.derived import PointMeasured

_COLOURS = (DATA, MODEL, SECOND, "#5b8c2a", "#222222")


def calibration_section(contents: Contents) -> ReportSection:
    """Gain and delay with their standard errors, and what they leave of the points."""
    title = "Calibration in place"
    if not contents.calibrations:
        text = "The vibrometer was not calibrated in place: gain and delay are as the instrument has them."
        return ReportSection(title, (Sentence(text, "note"),))
    rows = tuple(
        (name, with_error(c.gain, c.gain_std), with_error(c.delay_s, c.delay_std_s, 1e6), str(c.points))
        for name, c in contents.calibrations.items()
    )
    columns = ("range", "gain (reading over truth)", "delay / µs", "points")
    blocks: list[Block] = [
        Sentence("Reading over true velocity, with the laser on the base: gain times e^(-iω delay)."),
        TableBlock("± one standard error; both are taken off every point", columns, rows),
    ]
    if contents.calibration_points:
        blocks.append(FigureBlock(_figure(contents), "What gain and delay leave of the calibration points"))
    return ReportSection(title, tuple(blocks))


def _figure(contents: Contents) -> Figure:
    figure, ((gain, phase),) = panels(1, 2, 2.8)
    for colour, (name, found) in zip(_COLOURS, contents.calibrations.items(), strict=False):
        points = [p for p in contents.calibration_points if p.range_name == name]
        f = np.array([p.frequency_hz for p in points])
        ratio = np.array([_ratio(p) for p in points])
        rest = ratio / (found.gain * np.exp(-2j * np.pi * f * found.delay_s))
        gain.plot(f, 100 * (np.abs(rest) - 1), "o", color=colour, markersize=4, label=name)
        phase.plot(f, np.degrees(np.angle(rest)), "o", color=colour, markersize=4, label=name)
    for ax, y in ((gain, "Amplitude / %"), (phase, "Phase / degree")):
        ax.axhline(0, color="#888888", linewidth=0.8)
        label(ax, x="Frequency / Hz", y=y)
    legend_above(figure, gain)
    return figure


def _ratio(p: PointMeasured) -> complex:
    """Velocity over that of the base."""
    return p.velocity_m_s * 2j * np.pi * p.frequency_hz / p.base_m_s2
