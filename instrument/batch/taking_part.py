"""Which rows of a batch take part in a spread, in which group, and which of them repeat another."""

import os
from collections.abc import Iterable

import numpy as np

from fitting.arrays import Array
from instrument.batch.columns import cells, is_doubted
from instrument.batch.run import BatchRow

UNKNOWN = "unknown"
"""The verdict that leaves a law without a part: it may be biased by more than any spread."""
Group = tuple[str | None, float | None]
"""The table's `material` and the temperature in whole degrees Celsius; None where there is none."""


def group_of(row: BatchRow) -> Group:
    """Rows of one group are specimens of one material at one temperature."""
    temperature = cells(row)["temperature_c"]
    warm = round(temperature) + 0.0 if isinstance(temperature, int | float) else None
    return row.task.material, warm


def law_of(row: BatchRow) -> dict[str, Array] | None:
    """The columns of its law, shape (frequencies,) each; None where it has none to believe.

    None for a row that failed, whose verdict is unknown, whose law says that it may be biased or has no
    standard errors.
    """
    o = row.outcome
    if o["failed"] or o["verdict"] == UNKNOWN or is_doubted(row):
        return None
    law = {key: np.array(values, dtype=float) for key, values in (o.get("law") or {}).items()}
    if not law or not all(np.isfinite(v).all() for v in law.values()) or np.any(law["loss_factor"] <= 0):
        return None
    return law


def repeats_among(rows: Iterable[BatchRow]) -> dict[int, str]:
    """Place of each row whose data an earlier row of its group has already, and that row's data.

    Told by contents, whatever the files are called and whichever specimen they are given: one measurement
    counts once. Rows that take no part repeat nothing.
    """
    first: dict[tuple[str, Group], str] = {}
    found = {}
    for place, row in enumerate(rows):
        if law_of(row) is None:
            continue
        key = row.contents or os.path.realpath(row.task.data), group_of(row)
        if key in first:
            found[place] = first[key]
        else:
            first[key] = row.task.data
    return found
