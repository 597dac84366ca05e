"""How far long work has come."""

from collections.abc import Callable

Report = Callable[[float], None]
"""Told the fraction done, 0 to 1."""


def unheard(fraction: float) -> None:
    """Where nobody asked."""
