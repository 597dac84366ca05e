"""Dataclasses of arrays to and from flat named arrays, for files without pickle."""

from dataclasses import Field, fields, is_dataclass
from typing import Any, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")


def pack(value: Any, prefix: str = "") -> dict[str, NDArray[Any]]:
    """Every field that it is made of as an array, nested dataclasses as `outer.inner`.

    Shapes as in the fields, () of a number.
    """
    packed: dict[str, NDArray[Any]] = {}
    for field in _given(value):
        item, name = getattr(value, field.name), prefix + field.name
        if is_dataclass(item):
            packed |= pack(item, f"{name}.")
        else:
            packed[name] = np.asarray(item)
    return packed


def unpack(cls: type[T], packed: dict[str, NDArray[Any]], prefix: str = "") -> T:
    """The object that `pack` has taken apart.

    Raises `KeyError` where an array is missing. Shapes as `pack` gives them.
    """
    hints = get_type_hints(cls)
    values: dict[str, Any] = {}
    for field in _given(cls):
        hint, name = hints[field.name], prefix + field.name
        if is_dataclass(hint):
            values[field.name] = unpack(hint, packed, f"{name}.")  # type: ignore[arg-type]
        elif hint in (float, complex, int):
            values[field.name] = hint(packed[name][()])
        elif getattr(hint, "__origin__", None) is tuple:
            values[field.name] = tuple(float(v) for v in packed[name])
        else:
            values[field.name] = packed[name]
    return cls(**values)


def _given(of: Any) -> list[Field[Any]]:
    """Fields that are given; others are what it keeps as it is used."""
    return [field for field in fields(of) if field.init]
