"""Numbers as people read them: as many digits as their uncertainty leaves."""

import math

from fitting.digits import written_out

_OUT = 1e5
"""Below it a number needs no exponent: 1770 and not 1.77e+03."""


def with_error(value: float | None, error: float | None, scale: float = 1.0) -> str:
    """A value and its standard error, two digits of the error: `0.2700 ± 0.0013`; `scale` multiplies both."""
    if value is None or not math.isfinite(value):
        return "-"
    if error is None or not math.isfinite(error) or error <= 0:
        return format_number(value * scale)
    v, e = value * scale, error * scale
    digits = 1 - math.floor(math.log10(e))
    exponent = math.floor(math.log10(abs(v))) if v else 0
    if exponent < -3 or exponent > 5:
        places = max(0, digits + exponent)
        return f"({v / 10**exponent:.{places}f} ± {e / 10**exponent:.{places}f})e{exponent}"
    places = max(0, digits)
    # Of an error above a hundred the digits before the point are rounded too.
    return f"{round(v, digits):.{places}f} ± {round(e, digits):.{places}f}"


def format_number(value: float | None, digits: int = 4) -> str:
    """Some significant digits; a dash for nothing."""
    if value is None or not math.isfinite(value):
        return "-"
    return written_out(value, digits) if abs(value) < _OUT else f"{value:.{digits}g}"


def signed(value: float, places: int = 2) -> str:
    """With its sign."""
    return f"{value:+.{places}f}"
