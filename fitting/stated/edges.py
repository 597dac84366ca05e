"""How a plate's four edges are held, in the order x = 0, y = 0, x = length, y = width.

A clamped edge holds every motion. A simply supported one holds the deflection and what runs along the edge;
it may stretch across it, and turn about it.
"""

import re
from typing import Literal, cast

from fitting.errors import OutsideModel

Edge = Literal["clamped", "free", "simply-supported"]
Edges = tuple[Edge, Edge, Edge, Edge]

NAMED: dict[str, Edges] = {
    "cantilever": ("clamped", "free", "free", "free"),
    "simply-supported": ("simply-supported",) * 4,
    "free": ("free",) * 4,
}
"""Boundaries with a name of their own."""

_WORDS = ("clamped", "free", "simply-supported")
_ONE = "|".join(_WORDS)
_FOUR = re.compile("-".join([f"({_ONE})"] * 4))


def edges_of(boundary: str) -> Edges:
    """The edges of a boundary, by its name or edge by edge. Raises `OutsideModel`."""
    if boundary in NAMED:
        return NAMED[boundary]
    found = _FOUR.fullmatch(boundary)
    if found is None:
        raise OutsideModel(
            f"boundary {boundary!r:.60}, expected {', '.join(map(repr, NAMED))}, or four of "
            f'{", ".join(_WORDS)} for x=0, y=0, x=length, y=width: "clamped-free-free-free"'
        )
    return cast(Edges, found.groups())


def named(boundary: str) -> str:
    """The one way to write a boundary: its name where it has one. Raises `OutsideModel`."""
    edges = edges_of(boundary)
    return next((name for name, its in NAMED.items() if its == edges), "-".join(edges))
