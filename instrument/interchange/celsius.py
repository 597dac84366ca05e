"""A column of temperatures by the names that other programs give it, in degrees Celsius."""

from collections.abc import Callable

import numpy as np

from fitting.arrays import Array
from instrument.interchange.found import Found
from instrument.interchange.signals import Named
from instrument.interchange.unit_in_name import bracketed

OURS = "temperature_c"
_WORDS = frozenset(("temperature", "temp"))
_TO_CELSIUS: dict[str, Callable[[Array], Array]] = {
    **dict.fromkeys(("c", "°c", "degc", "deg c", "celsius"), lambda x: x),
    **dict.fromkeys(("k", "kelvin"), lambda x: x - 273.15),
    **dict.fromkeys(("f", "°f", "degf", "deg f", "fahrenheit"), lambda x: (x - 32) / 1.8),
}
_SHOWN = 4


def with_celsius(source: str, table: Named, found: Found) -> Named:
    """The table with its temperatures in the column of ours; as it is where they are there or none are.

    Of a column that does not say its unit, and of several, none is taken, which is said.
    """
    names = [n for n, x in table.items() if n != OURS and _is_warm(n) and not np.iscomplexobj(x)]
    if not names:
        return table
    if OURS in table or len(names) > 1:
        kept = f"{OURS} stands beside it" if OURS in table else "which is the specimen's?"
        found.said.append(f"passed over: {source}: {', '.join(names[:_SHOWN])}: {kept}")
        return _without(table, names)
    name = names[0]
    to_celsius = _TO_CELSIUS.get(_unit(name))
    if to_celsius is None:
        found.said.append(f"passed over: {source}: {name}: in C, K or F? expected it in its name")
        return _without(table, names)
    celsius = to_celsius(np.asarray(table[name], float))
    known = celsius[np.isfinite(celsius)]
    if known.size:
        found.said.append(f"{source}: {name} as {OURS}, {known.min():.4g} to {known.max():.4g}")
    return {OURS if n == name else n: celsius if n == name else x for n, x in table.items()}


def is_temperature(name: str) -> bool:
    """Whether a column that is so called is of temperatures, in whatever unit."""
    return name == OURS or _is_warm(name)


def _is_warm(name: str) -> bool:
    return bool(_WORDS & set(bracketed(name)[1]))


def _unit(name: str) -> str:
    """In brackets, or the words behind the temperature: `Temp_K`, `temperature deg F`."""
    unit, words = bracketed(name)
    behind = max(k for k, word in enumerate(words) if word in _WORDS) + 1
    return unit.strip().lower() or " ".join(words[behind:])


def _without(table: Named, names: list[str]) -> Named:
    return {n: x for n, x in table.items() if n not in names}
