"""A law's formula again, of what a result says of it."""

from collections.abc import Mapping
from dataclasses import fields

from fitting.laws import LAWS, CoreLaw


def formula(kind: str, parameters: Mapping[str, float]) -> CoreLaw:
    """A law of the kind with these parameters, no bend in it.

    Raises `KeyError` for a kind that needs more than those.
    """
    cls = LAWS[kind]
    if set(cls.file_fields()) - set(cls.quantities()):
        raise KeyError(f"{kind} has numbers that are not parameters")
    return cls(**{f.name: _values(parameters, f.name) for f in fields(cls) if f.name in cls.quantities()})


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
