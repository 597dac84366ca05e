"""Sizes of effects in the units of a workshop: a millimetre and a gram are what a ruler and scales say."""

import math

_SHOWN = {"m": (1e3, "mm"), "kg": (1e3, "g")}
_NOTHING = 1e-7
"""Of a share, a length or a mass in SI units: below it is what rounding leaves of a limit at zero."""
_NEAR_ONE = 0.5
"""A pure number nearer to 1 is a factor of something."""
_ENDS_AT_ZERO = ("1", "m", "kg")


def shown_in(unit: str) -> tuple[float, str]:
    """What a value in `unit` is multiplied by to be shown, and in which unit; none for a pure number."""
    return _SHOWN.get(unit, (1.0, "" if unit == "1" else unit))


def size_shown(value: float, unit: str) -> tuple[str, str]:
    """A size in `unit` in the figures that count, and the unit it is shown in; empty for a pure number."""
    scale, shown = shown_in(unit)
    # Of a factor near 1 what counts stands further behind.
    digits = 5 if not shown and abs(value - 1) < _NEAR_ONE else 3
    return f"{scale * value:.{digits}g}", shown


def without_rounding(value: float, error: float, unit: str) -> float:
    """The value, and 0 where it stopped at that limit: without a standard error, and next to nothing."""
    at_limit = not math.isfinite(error) and abs(value) < _NOTHING
    return 0.0 if at_limit and unit in _ENDS_AT_ZERO else value
