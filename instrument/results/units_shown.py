"""Sizes of effects in the units of a workshop: a millimetre and a gram are what a ruler and scales say."""

import math

_SHOWN = {"m": (1e3, "mm"), "kg": (1e3, "g")}
_NOTHING = 1e-7
"""Of a share, a length or a mass in SI units: below it is what rounding leaves of a limit at zero."""
_ENDS_AT_ZERO = ("1", "m", "kg")


def shown_in(unit: str) -> tuple[float, str]:
    """What a value in `unit` is multiplied by to be shown, and in which unit; none for a pure number."""
    return _SHOWN.get(unit, (1.0, "" if unit == "1" else unit))


def without_rounding(value: float, error: float, unit: str) -> float:
    """The value, and 0 where it stopped at that limit: without a standard error, and next to nothing."""
    at_limit = not math.isfinite(error) and abs(value) < _NOTHING
    return 0.0 if at_limit and unit in _ENDS_AT_ZERO else value
