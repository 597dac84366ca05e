"""Rows of one material and temperature without a common band: which of them spoil it, in words."""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import PurePath

import numpy as np

from instrument.batch.run import BatchRow
from instrument.batch.taking_part import Group, groups_of, taking_part
from instrument.material.spread import FEWEST

NO_SPREAD = "No three rows of one material, within 1.5 K, have a band in common: no spread is told."
"""For people."""
_NAMED = 5
"""Rows that a sentence names."""
_Band = tuple[float, float, str]
"""Lowest and highest frequency of a row in Hz, and its data."""


def without_spread(rows: Iterable[BatchRow], repeats: Mapping[int, str], told: int) -> list[str]:
    """A sentence for each group that a few rows leave without a common band.

    `told` is how many groups have a spread: of none, and nothing to say of a group, `NO_SPREAD`. `repeats`
    are those that count no more, by place.
    """
    groups = groups_of(rows)
    bands: dict[Group, list[_Band]] = defaultdict(list)
    for place, row, law in taking_part(rows, repeats):
        f = law["frequency_hz"]
        bands[groups[place]].append((float(f[0]), float(f[-1]), row.task.data))
    said = [line for group, some in bands.items() if (line := _said(group, some))]
    return said or ([] if told else [NO_SPREAD])


def _said(group: Group, bands: list[_Band]) -> str:
    """Empty where all of them have a band in common, or no three."""
    from_hz, to_hz, _ = zip(*bands, strict=True)
    lows, highs = np.sort(from_hz), np.sort(to_hz)
    # How many bands hold what lies just above each one's lower end.
    holding = np.searchsorted(lows, lows, side="right") - np.searchsorted(highs, lows, side="right")
    most = int(np.argmax(holding))
    if not FEWEST <= holding[most] < len(bands):
        return ""
    at = lows[most]
    out = [band for band in bands if not band[0] <= at < band[1]]
    high = min(b[1] for b in bands if b[0] <= at < b[1])
    material, warm = group
    of = (f" of {material}" if material is not None else "") + (
        f" at {warm:g} degC" if warm is not None else ""
    )
    named = [f"{PurePath(data).name} ({a:.4g} to {b:.4g} Hz)" for a, b, data in out[:_NAMED]]
    more = f" and {len(out) - _NAMED} more" if len(out) > _NAMED else ""
    has = "has" if len(out) == 1 else "have"
    return (
        f"No spread of the {len(bands)} rows{of}: {holding[most]} have {at:.4g} to {high:.4g} Hz in common, "
        f"{', '.join(named)}{more} {has} no band with all of them. Leave out what is not to be compared, or "
        "give it another word in the table's column `material`."
    )
