"""Which rows of a batch take part in a spread, in which group, and which of them repeat another."""

import os
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from fitting.arrays import Array
from instrument.batch.columns import cells, is_doubted
from instrument.batch.run import BatchRow

UNKNOWN = "unknown"
"""The verdict that leaves a law without a part: it may be biased by more than any spread."""
Group = tuple[str | None, float | None]
"""The table's `material` and its rows' mean temperature to a tenth of a kelvin; None where there is none."""
_GAP_K, _WIDE_K = 0.5, 1.5
"""Between neighbours of one temperature, and from its lowest to its highest. A choice: a room wanders by as
much within a day, and a rubber changes by 3 to 5 % a kelvin."""


def groups_of(rows: Iterable[BatchRow]) -> list[Group]:
    """The group of every row: specimens of one material at about one temperature."""
    of = [(row.task.material, _temperature(row)) for row in rows]
    known = defaultdict[str | None, set[float]](set)
    for material, warm in of:
        if warm is not None:
            known[material].add(warm)
    means = {material: _means(sorted(some)) for material, some in known.items()}
    return [(material, None if warm is None else means[material][warm]) for material, warm in of]


def _temperature(row: BatchRow) -> float | None:
    found = cells(row)["temperature_c"]
    return float(found) if isinstance(found, int | float) else None


def _means(ascending: list[float]) -> dict[float, float]:
    """Of each temperature that of the group it is in."""
    found: dict[float, float] = {}
    group: list[float] = []
    for warm, following in zip(ascending, [*ascending[1:], np.inf], strict=True):
        group.append(warm)
        if following - warm > _GAP_K or following - group[0] > _WIDE_K:
            found |= dict.fromkeys(group, round(float(np.mean(group)), 1) + 0.0)
            group = []
    return found


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


def taking_part(
    rows: Iterable[BatchRow], repeats: Mapping[int, str]
) -> Iterator[tuple[int, BatchRow, dict[str, Array]]]:
    """Place, row and law of those that have one to believe and repeat no other.

    Shape (frequencies,) each column of a law.
    """
    for place, row in enumerate(rows):
        law = law_of(row) if place not in repeats else None
        if law is not None:
            yield place, row, law


_SAVED_AGAIN = 1e-4
"""Relative, over all of a band: laws so alike are of one measurement, written with fewer digits or another
comment. Two measurements differ by their noise, some thousandths over the root of their points, somewhere."""


def repeats_among(rows: Iterable[BatchRow]) -> dict[int, str]:
    """Place of each row whose data an earlier row of its group has already, and that row's data.

    Told by contents, whatever the files are called and whichever specimen they are given, and by laws that
    are one to four digits: one measurement counts once. A row that has no law to believe repeats by its
    contents alone, and is repeated by none that has one; a row that failed repeats nothing.
    """
    first: dict[tuple[str, Group], str] = {}
    unbelieved: dict[tuple[str, Group], str] = {}
    laws = defaultdict[Group, list[tuple[str, Array]]](list)
    found = {}
    for place, (row, group) in enumerate(zip(rows, groups_of(rows), strict=True)):
        if row.outcome["failed"]:
            continue
        key = row.contents or os.path.realpath(row.task.data), group
        law = law_of(row)
        if law is None:
            alike = first.get(key) or unbelieved.get(key)
            if alike is not None:
                found[place] = alike
            unbelieved.setdefault(key, row.task.data)
            continue
        curve = np.concatenate([law["frequency_hz"], law["storage_modulus_pa"], law["loss_factor"]])
        earlier = first.get(key) or next((data for data, other in laws[group] if _is_one(curve, other)), None)
        if earlier is not None:
            found[place] = earlier
            continue
        first[key] = row.task.data
        laws[group].append((row.task.data, curve))
    return found


def _is_one(curve: Array, other: Array) -> bool:
    # Nearly all differ in any one number by more.
    if curve.shape != other.shape or abs(curve[-1] - other[-1]) > _SAVED_AGAIN * abs(other[-1]):
        return False
    return bool(np.all(np.abs(curve / other - 1) < _SAVED_AGAIN))
