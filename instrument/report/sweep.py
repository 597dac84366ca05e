"""The sweep: response, quality of its points, remarks, drift of the sentinel."""

import numpy as np

from fitting.data.aside import Reasons
from fitting.digits import two_digits
from instrument.files.acceleration import acceleration_unit
from instrument.files.column import ColumnPoint
from instrument.files.point_columns import in_report
from instrument.report.blocks import Block, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.report.fitted import ReportedFit
from instrument.report.measured import points_set_aside, relative_noise, segments_of
from instrument.report.sweep_figures import quality_figure, response_figures
from instrument.results.numbers import format_number, signed
from instrument.results.quality import how_long
from instrument.results.set_aside import why_aside, words_of
from instrument.session.contents import Contents
from instrument.stream.derived import PointMeasured


def sweep_section(contents: Contents, fitted: ReportedFit) -> ReportSection:
    """What was measured of the damped specimen."""
    title = f"Sweep of the damped {contents.specimen.kind.replace('-', ' ')}"
    if not contents.points:
        return ReportSection(title, (Sentence("There is no point of a sweep in this session.", "note"),))
    blocks: list[Block] = [Sentence(_summary(contents))]
    why = why_aside(contents.measured, points_set_aside(contents, fitted.points_set_aside))
    segments = segments_of(contents, fitted.points_set_aside)
    reads = contents.configuration.rig.vibrometer.reads
    drawn = f"{reads.capitalize()} velocity v at the pickup over base acceleration a, by segment"
    drawn += "" if fitted.fit is not None else "; no model is drawn, as there is no fit"
    found = contents.diagnosis.result if contents.diagnosis is not None else None
    blocks += [FigureBlock(f, drawn) for f in response_figures(segments, fitted, found)]
    quality = "How well each point was measured, in the order of measuring" + _counted_from(contents)
    blocks.append(FigureBlock(quality_figure(contents), quality))
    blocks += [*_set_aside(contents.measured, why), *_sentinels(contents), *_remarks(contents.measured)]
    blocks.append(_points(contents))
    return ReportSection(title, tuple(blocks))


def _summary(contents: Contents) -> str:
    steps = [p for p in contents.measured if p.purpose == "step"]
    if not steps:
        return "Only sentinel points were measured."
    off = max(abs(p.control_error_percent) for p in steps)
    noise = 100 * float(np.median(relative_noise(steps, "velocity")))
    shown = acceleration_unit()
    levels_m_s2 = sorted({round(p.level_m_s2, 6) for p in steps})
    levels = ", ".join(f"{shown.of(v):.4g}" for v in levels_m_s2)
    marked = sum(bool(p.remarks) for p in steps)
    segments, sweeps = len({p.segment for p in steps}), len({p.sweep for p in steps})
    return (
        f"{_counted(len(steps), 'step')} in {_counted(segments, 'segment')} and {_counted(sweeps, 'sweep')} "
        f"at {levels} {shown.symbol}: {how_long(contents.measured)}. "
        f"The base was within {off:.2f} % of its level, the velocity's noise is {two_digits(noise)} % "
        f"(median); {_counted(marked, 'step')} with remarks."
    )


def _counted_from(contents: Contents) -> str:
    """Why the first step of the sweep is not step 1; empty where it is."""
    first = min((p.step for p in contents.measured), default=1)
    if first <= 1:
        return ""
    return f"; steps 1 to {first - 1} of the run were its loop check and calibration"


def _counted(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"


def _sentinels(contents: Contents) -> list[Block]:
    """The sentinel against its first time."""
    if not contents.sentinels:
        return [Sentence("The sentinel was not measured twice: nothing is said about drift.", "note")]
    at = {p.point.step: p for p in contents.points}
    rows = []
    for s in contents.sentinels:
        timed = at.get(s.step)
        when = f"{(timed.time_s - contents.points[0].time_s) / 60:.1f}" if timed else "-"
        temperature = format_number(timed.point.temperature_c, 4) if timed else "-"
        change = (signed(s.change_percent, 3), signed(s.change_degree, 3))
        rows.append((str(s.step), f"{s.frequency_hz:g}", when, *change, temperature))
    columns = ("step", "f / Hz", "after / min", "amplitude / %", "phase / degree", "T / °C")
    return [TableBlock("Drift of the sentinel, against its first time", columns, tuple(rows))]


def _set_aside(points: list[PointMeasured], why: Reasons) -> list[Block]:
    """What fit or diagnosis leave out. `why` of shape (points,)."""
    rows = tuple(
        (str(p.step), f"{p.frequency_hz:g}", str(p.segment), f"{abs(p.velocity_m_s):.5g}", words_of(reason))
        for p, reason in zip(points, why.tolist(), strict=True)
        if reason
    )
    columns = ("step", "f / Hz", "segment", "|v| / (m/s)", "why")
    title = f"{_counted(len(rows), 'reading')} set aside, not fitted"
    return [TableBlock(title, columns, rows, words=columns[4:])] if rows else []


def _remarks(points: list[PointMeasured]) -> list[Block]:
    marked = [p for p in points if p.remarks]
    if not marked:
        return [Sentence("No point carries a remark.")]
    rows = tuple((str(p.step), f"{p.frequency_hz:g}", str(p.segment), "; ".join(p.remarks)) for p in marked)
    return [TableBlock("Points with remarks", ("step", "f / Hz", "segment", "remark"), rows)]


def _points(contents: Contents) -> TableBlock:
    shown = [shown for _, shown in in_report()]
    rows = tuple(tuple(s.text(ColumnPoint(p)) for s in shown) for p in contents.measured)
    columns = tuple(s.heading for s in shown)
    return TableBlock(f"All {len(rows)} points", columns, rows, folded=True)
