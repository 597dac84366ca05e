"""Everything there is to say of one point. No Qt."""

from dataclasses import dataclass

import numpy as np

from gui.pages.sweep.seen import PaneContents, Way
from instrument.files.column import ColumnPoint
from instrument.files.point_columns import in_record
from instrument.results.quality import QUALITIES
from instrument.results.set_aside import words_of
from instrument.stepped_sine.settings import SweepSettings


@dataclass(frozen=True)
class RecordLine:
    """A quantity of a point."""

    name: str
    value: str
    """With its unit."""
    tip: str = ""


def record_lines(seen: PaneContents, number: int, settings: SweepSettings) -> list[RecordLine]:
    """All of a point's record, what matters most first."""
    timed = seen.points.timed[number]
    row = ColumnPoint(timed.point, timed.time_s, tolerance_percent=100 * settings.control.tolerance)
    why = seen.points.why_aside[number]
    first, *others = [RecordLine(shown.label, shown.text(row), shown.tip) for _, shown in in_record()]
    return [
        first,
        RecordLine("Quality", QUALITIES[seen.points.quality[number]], "Against the tolerances of the sweep"),
        *(RecordLine("Remark", remark) for remark in timed.point.remarks),
        *([RecordLine("Set aside, not fitted", words_of(why))] if why else []),
        *_response(seen, number),
        *_predictions(seen, number),
        *others,
    ]


def _response(seen: PaneContents, number: int) -> list[RecordLine]:
    p, z = seen.points, seen.points.over_base_s[number]
    noise = float(np.hypot(p.noise_percent("velocity")[number], p.noise_percent("base")[number]))
    tip = f"Velocity over base acceleration, {seen.reads}"
    way = Way()
    return [
        RecordLine("|v/a|", f"{way.factor(1.0) * abs(z):.5g} {way.unit}", tip),
        RecordLine("Phase of v/a", f"{np.degrees(np.angle(z)):.3f}\u00b0", tip),
        RecordLine(
            "Noise of v/a",
            f"{noise:.2g} %, {np.degrees(noise / 100):.2g}\u00b0",
            "Standard deviation by the noise of both channels",
        ),
    ]


def _predictions(seen: PaneContents, number: int) -> list[RecordLine]:
    """By the fit, and with the effects that the diagnosis accepts."""
    p, explained = seen.points, seen.explained
    measured = float(abs(p.over_base_s[number]) * p.level_m_s2[number])
    said = (
        (f"Fit {seen.fit} predicts", "", seen.predicted.of(number)),
        ("Diagnosis predicts", f"The law {explained.name}. ", explained.of(number)),
    )
    return [
        RecordLine(
            name,
            f"{1e3 * predicted:.5g} mm/s, {100 * (predicted - measured) / measured:+.2f} %",
            f"{what}Amplitude at the level commanded, and its difference to the measured one",
        )
        for name, what, predicted in said
        if predicted is not None
    ]
