"""Columns of a sweep CSV that are not read and whose names say nearly what one of ours is."""

import re
from collections.abc import Sequence

_MEANT = {
    **dict.fromkeys(("time", "zeit"), "time_s"),
    **dict.fromkeys(("temperature", "temperatur", "temp"), "temperature_c"),
    **dict.fromkeys(("segment", "segments"), "segment"),
    **dict.fromkeys(("sweep", "sweeps", "pass", "passes"), "sweep"),
    **dict.fromkeys(("pickup", "pickups"), "pickup"),
    **dict.fromkeys(("std", "stdev"), "velocity_std_m_s"),
}
"""First words, and the column meant by them."""
_BEHIND = {
    *("no", "nr", "number", "id", "index", "velocity"),
    *(
        "s",
        "sec",
        "ms",
        "min",
        "h",
        "c",
        "k",
        "f",
        "deg",
        "degc",
        "degk",
        "degf",
        "celsius",
        "kelvin",
        "m",
        "mm",
    ),
}
"""Words that may follow: numbers and units. With others it is something else: `time_constant_s`."""


def near_columns(header: Sequence[str]) -> dict[str, str]:
    """Columns by name, each with the one of ours that it is like and that the header lacks."""
    found = {}
    for name in header:
        words = [word for word in re.split(r"[^a-z]+", name.lower()) if word]
        own = _MEANT.get(words[0], "") if words and set(words[1:]) <= _BEHIND else ""
        if own and own not in header:
            found[name] = own
    return found


def words_of_near(path: object, header: Sequence[str]) -> str:
    """One line for people; empty where there are none."""
    near = near_columns(header)
    if not near:
        return ""
    pairs = ", ".join(f"{name} (is it {own}?)" for name, own in near.items())
    return f"{path}: not read, as columns of no known name: {pairs}"
