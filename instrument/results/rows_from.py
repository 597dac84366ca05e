"""Rows that an identification and a diagnosis both have, read off a fit."""

from collections.abc import Sequence
from dataclasses import asdict

from fitting.identification.adjusted import Adjusted
from fitting.identification.result import LawBand
from fitting.identification.validation import Validation
from instrument.facts.rows import AdjustedNumber, HeldOut, LawRow


def law_rows_from(b: LawBand) -> tuple[LawRow, ...]:
    """A row a frequency."""
    keys = tuple(LawRow.model_fields)
    columns = (getattr(b, key).tolist() for key in keys)
    return tuple(LawRow(**dict(zip(keys, row, strict=True))) for row in zip(*columns, strict=True))


def held_out_from(v: Validation) -> tuple[HeldOut, ...]:
    """Each segment predicted from the others."""
    return tuple(
        HeldOut(segment=int(h.segment), rms_percent=h.rms_percent, noise_percent=h.noise_percent)
        for h in v.held_out
    )


def adjusted_from(found: Sequence[Adjusted]) -> tuple[AdjustedNumber, ...]:
    """The stated numbers beside what the fit found them to be."""
    return tuple(AdjustedNumber(**asdict(one)) for one in found)
