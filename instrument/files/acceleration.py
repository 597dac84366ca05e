"""The unit in which people are shown acceleration. Files, results and their keys have m/s^2 and `level_g`.

One choice for all of a program, as a theme is: the window's setting, or a command's `--acceleration`.
"""

from dataclasses import dataclass
from typing import TypeVar

from fitting.arrays import Array
from fitting.gravity import PUBLISHED_G_M_S2, STANDARD_GRAVITY_M_S2

Values = TypeVar("Values", float, Array)


@dataclass(frozen=True)
class AccelerationUnit:
    """A unit of acceleration, and how values are said in it."""

    symbol: str
    """On a screen or a page."""
    plain: str
    """In a terminal."""
    m_s2: float
    """One of it."""

    def of(self, value_m_s2: Values) -> Values:
        """A value in this unit. Shape of the value."""
        return value_m_s2 / self.m_s2

    def said(self, value_m_s2: float, spec: str = ".4g") -> str:
        """A value with its unit."""
        return f"{self.of(value_m_s2):{spec}} {self.symbol}"

    def typed(self, value_m_s2: float, spec: str = ".4g") -> str:
        """A value with its unit, in a terminal."""
        return f"{self.of(value_m_s2):{spec}} {self.plain}"

    @property
    def under(self) -> str:
        """Behind a stroke: `mV/(m/s\u00b2)`."""
        return f"({self.symbol})" if "/" in self.symbol else self.symbol


UNITS = {
    "m/s2": AccelerationUnit("m/s\u00b2", "m/s^2", 1.0),
    "g": AccelerationUnit("g", "g", STANDARD_GRAVITY_M_S2),
}
"""By the name of the choice."""
USUAL = "m/s2"
_SI = UNITS[USUAL].plain
_chosen = USUAL


def show_acceleration_in(name: str) -> None:
    """From now on; the usual unit for a name that is none."""
    global _chosen
    _chosen = name if name in UNITS else USUAL


def acceleration_unit() -> AccelerationUnit:
    """The unit of acceleration that is chosen."""
    return UNITS[_chosen]


def shown_as() -> list[str]:
    """The choice as another command is told of it."""
    return ["--acceleration", _chosen]


def shown_quantity(value: float, unit: str) -> tuple[float, str]:
    """A value of any quantity and its unit as people are shown it: accelerations in the unit chosen."""
    if unit != _SI:
        return value, unit
    return acceleration_unit().of(value), acceleration_unit().plain


def in_both(value_m_s2: float) -> str:
    """In a sentence that a result keeps, whatever unit is chosen: in m/s^2 and in g."""
    usual, other = UNITS.values()
    return f"{usual.typed(value_m_s2, '.3g')} ({other.typed(value_m_s2, '.3g')})"


def said_beside(key: str, value: object) -> str:
    """What a file's value is in the unit chosen, where its key has another one; else empty."""
    shown = acceleration_unit()
    if isinstance(value, bool) or not isinstance(value, int | float):
        return ""
    if key == "level_g" and shown is UNITS[USUAL]:
        # A level counts the published case's g.
        return f"= {shown.said(value * PUBLISHED_G_M_S2)}"
    if key.endswith("_m_s2") and shown is not UNITS[USUAL]:
        return f"= {shown.said(value)}"
    return ""
