"""How far the building of a plant has come."""

from collections.abc import Callable

Report = Callable[[float], None]
"""Told the fraction done, 0 to 1."""
