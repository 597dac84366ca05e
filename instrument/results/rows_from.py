"""Rows that an identification and a diagnosis both have, read off a fit."""

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np

from fitting.arrays import Array
from fitting.data.aside import Reasons
from fitting.identification.adjusted import Adjusted
from fitting.identification.result import LawBand
from fitting.identification.validation import Validation
from fitting.sweep import Sweep
from instrument.facts.rows import AdjustedNumber, HeldOut, LawKnown, LawRow, PointSetAside


def law_rows_from(b: LawBand) -> tuple[LawRow, ...]:
    """A row a frequency."""
    keys = tuple(LawRow.model_fields)
    columns = (getattr(b, key).tolist() for key in keys)
    return tuple(LawRow(**dict(zip(keys, row, strict=True))) for row in zip(*columns, strict=True))


def law_known_from(b: LawBand) -> LawKnown | None:
    """What is known of the band's curve as a whole."""
    known = b.known
    if known is None:
        return None
    passed_on = known.by_stated.T.tolist()
    return LawKnown(
        frequency_hz=tuple(known.frequency_hz.tolist()),
        covariance=_triangle(known.covariance),
        of_another_measurement=_triangle(known.of_another_measurement),
        stated={name: tuple(column) for name, column in zip(known.stated, passed_on, strict=True)},
    )


def _triangle(C: Array) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(row[: k + 1]) for k, row in enumerate(C.tolist()))


def held_out_from(v: Validation) -> tuple[HeldOut, ...]:
    """Each segment predicted from the others."""
    return tuple(
        HeldOut(segment=int(h.segment), rms_percent=h.rms_percent, noise_percent=h.noise_percent)
        for h in v.held_out
    )


def adjusted_from(found: Sequence[Adjusted]) -> tuple[AdjustedNumber, ...]:
    """The stated numbers beside what the fit found them to be."""
    return tuple(AdjustedNumber(**asdict(one)) for one in found)


def points_set_aside_from(given: Sweep, why: Reasons) -> tuple[PointSetAside, ...]:
    """Of all readings given those that have a reason, of shape (points,), to take no part."""
    out = np.flatnonzero(why != "")
    left = given.take(out)
    columns = (
        left.frequency_hz,
        left.segment,
        left.sweep,
        left.commanded_m_s2,
        np.abs(left.response_m_s),
        why[out],
    )
    return tuple(
        PointSetAside(
            frequency_hz=f, segment=segment, sweep=number, level_m_s2=level, measured_m_s=v, why=one
        )
        for f, segment, number, level, v, one in zip(*(c.tolist() for c in columns), strict=True)
    )
