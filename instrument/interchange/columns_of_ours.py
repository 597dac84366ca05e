"""Columns of ours by the names that other programs give them: times, passes, regions, spots, weights."""

import numpy as np

from instrument.interchange.found import Found
from instrument.interchange.signals import Named
from instrument.interchange.unit_in_name import bracketed

TIME = "time_s"
_TIMES = ("time", "t")
_SECONDS = {
    **dict.fromkeys(("s", "sec", "second", "seconds", "sekunden"), 1.0),
    **dict.fromkeys(("ms", "millisecond", "milliseconds", "millisekunden"), 1e-3),
    **dict.fromkeys(("min", "minute", "minutes", "minuten"), 60.0),
    **dict.fromkeys(("h", "hr", "hour", "hours", "stunden"), 3600.0),
}
_COUNTED = ("sweep", "segment", "pickup", "weight")
"""In files of ours by the same word."""
_NUMBER = frozenset(("no", "nr", "number", "id", "index"))
"""Words behind what is counted."""
_NO_UNIT = ("", "-", "1", "#")
_SHOWN = 4


def with_columns_of_ours(source: str, table: Named, found: Found) -> Named:
    """A sweep's table with such columns under the names of ours, times in s; all others as they are.

    Of several, of a time that does not say its unit, and of one not known of every row, none is taken; said.
    """
    meant: dict[str, list[str]] = {}
    for name, values in table.items():
        own = ours(name)
        if own and own != name and not np.iscomplexobj(values):
            meant.setdefault(own, []).append(name)
    changed, left = dict[str, str](), set[str]()
    for own, names in meant.items():
        why = _why_not(own, names, table)
        if why:
            found.said.append(f"passed over: {source}: {', '.join(names[:_SHOWN])}: {why}")
            left |= set(names)
        else:
            changed[names[0]] = own
    if changed:
        found.said.append(f"{source}: {', '.join(f'{name} as {own}' for name, own in changed.items())}")
    return {changed.get(n, n): _values(n, x, changed) for n, x in table.items() if n not in left}


def ours(name: str) -> str:
    """Which column of ours one is by its name; empty for none."""
    unit, words = bracketed(name)
    if _unit_of_time(name) is not None:
        return TIME
    is_counted = bool(words) and words[0] in _COUNTED and set(words[1:]) <= _NUMBER
    return words[0] if is_counted and unit.strip() in _NO_UNIT else ""


def _unit_of_time(name: str) -> str | None:
    """As it stands in a name, empty where it does not; None of what is no time by its words."""
    unit, words = bracketed(name)
    said, behind = unit.strip().lower(), [w for w in words[1:] if w != "in"]
    if words[:1] not in ([t] for t in _TIMES) or len(behind) > (not said):
        return None
    said = said or "".join(behind)
    is_sure = said in _SECONDS or (words[0] == _TIMES[0] and not behind)
    return said if is_sure else None


def _why_not(own: str, names: list[str], table: Named) -> str:
    """What keeps columns from being one of ours; empty where nothing does."""
    if own in table:
        return f"{own} stands beside it"
    if len(names) > 1:
        return "which of them? expected one"
    if own == TIME and _unit_of_time(names[0]) not in _SECONDS:
        return "in s, ms, min or h? expected it in its name"
    return "" if np.all(np.isfinite(table[names[0]])) else "not known of every row"


def _values(name: str, values: np.ndarray, changed: dict[str, str]) -> np.ndarray:
    return values * _SECONDS[_unit_of_time(name) or ""] if changed.get(name) == TIME else values
