"""Numbers as people read them: as many digits as their uncertainty leaves."""

import math

from fitting.digits import written_out

_OUT = 1e5
"""Below it a number needs no exponent: 1770 and not 1.77e+03."""


def with_error(value: float | None, error: float | None, scale: float = 1.0, sign: str = "±") -> str:
    """A value and its standard error, two digits of the error: `0.2700 ± 0.0013`; `scale` multiplies both.

    A terminal's `sign` is `+-`.
    """
    if value is None or not math.isfinite(value):
        return "-"
    if error is None or not math.isfinite(error) or error <= 0:
        return format_number(value * scale)
    v, e = value * scale, error * scale
    exponent = math.floor(math.log10(max(abs(v), e)))
    if exponent < -3 or exponent > 5:
        places = max(0, _places(e) + exponent)
        return f"({v / 10**exponent:.{places}f} {sign} {e / 10**exponent:.{places}f})e{exponent}"
    return f"{_to(v, _places(e))} {sign} {_to(e, _places(e))}"


def to_error(value: float, error: float) -> str:
    """A value alone, with the digits that its standard error leaves: that stands in a column of its own."""
    if not math.isfinite(error) or error <= 0 or not math.isfinite(value):
        return format_number(value)
    exponent = math.floor(math.log10(max(abs(value), error)))
    if exponent < -3 or exponent > 5:
        return f"{value / 10**exponent:.{max(0, _places(error) + exponent)}f}e{exponent}"
    return _to(value, _places(error))


def error_beside(value: float, error: float) -> str:
    """The standard error as it stands beside `to_error`: two digits, and the same exponent."""
    exponent = math.floor(math.log10(max(abs(value), error)))
    if exponent < -3 or exponent > 5:
        return f"{error / 10**exponent:.{max(0, _places(error) + exponent)}f}e{exponent}"
    return _to(error, _places(error))


def _places(error: float) -> int:
    """After the point, of two digits of an error; negative where they stand before it."""
    # 0.0996 is 0.10 and not 0.100.
    return 1 - math.floor(math.log10(float(f"{error:.1e}")))


def _to(value: float, places: int) -> str:
    """Of an error above a hundred the digits before the point are rounded too."""
    return f"{round(value, places):.{max(0, places)}f}"


def format_number(value: float | None, digits: int = 4) -> str:
    """Some significant digits; a dash for nothing."""
    if value is None or not math.isfinite(value):
        return "-"
    return written_out(value, digits) if abs(value) < _OUT else f"{value:.{digits}g}"


def signed(value: float, places: int = 2) -> str:
    """With its sign; what is rounded to nothing is +0."""
    return f"{round(value, places) + 0.0:+.{places}f}"
