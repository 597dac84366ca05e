"""A law's formula again, of what a result says of it."""

import re
from collections.abc import Mapping
from dataclasses import fields

from fitting.laws import LAWS, CoreLaw
from fitting.laws.base import Quantity

_NUMBER = re.compile(r"_\d+")
"""Of a list's item: g_1_pa is one of g_pa."""


def formula(kind: str, parameters: Mapping[str, float]) -> CoreLaw:
    """A law of the kind with these parameters, no bend in it.

    Raises `KeyError` for a kind that needs more than those, `OutsideModel` beyond its limits.
    """
    cls = LAWS[kind]
    if set(cls.file_fields()) - set(cls.quantities()):
        raise KeyError(f"{kind} has numbers that are not parameters")
    return cls(**{f.name: _values(parameters, f.name) for f in fields(cls) if f.name in cls.quantities()})


def limits(kind: str, parameters: Mapping[str, float]) -> dict[str, Quantity]:
    """What each of these parameters is, by its name; those that the kind does not know are left out."""
    known = LAWS[kind].quantities() if kind in LAWS else {}
    plain = {key: key if key in known else _NUMBER.sub("", key, count=1) for key in parameters}
    return {key: known[name] for key, name in plain.items() if name in known}


def _values(parameters: Mapping[str, float], name: str) -> float | tuple[float, ...]:
    """A parameter, or a list's items in their order: g_pa from g_1_pa, g_2_pa, ..."""
    if name in parameters:
        return parameters[name]
    stem, _, unit = name.partition("_")
    items: list[float] = []
    while (key := f"{stem}_{len(items) + 1}" + (f"_{unit}" if unit else "")) in parameters:
        items.append(parameters[key])
    if not items:
        raise KeyError(name)
    return tuple(items)
