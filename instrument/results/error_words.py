"""Standard errors as people read them. Numbers in files keep all their digits."""

from math import floor, isfinite, log10

from fitting.digits import two_digits
from instrument.results.numbers import with_error

FLOOR_PERCENT = 0.01
"""Of a parameter. Below it not noise limits it but the plate's theory, its mesh and its stated sizes."""


def percent_words(error: float, value: float) -> str:
    """Of the value; a dash where it is not known."""
    if not isfinite(error) or not value:
        return "-"
    percent = 100 * error / abs(value)
    return f"below {FLOOR_PERCENT:g}" if percent < FLOOR_PERCENT else two_digits(percent)


def ratio_words(ratio: float, error: float, sign: str = "+-") -> str:
    """A damping ratio in percent with its error; the floor where the error is below it."""
    if not is_below_floor(error, ratio):
        return with_error(ratio, error, 100, sign)
    return f"{100 * ratio:.{_floor_digits(ratio)}f} {sign} {ratio_error_words(ratio, error)}"


def ratio_error_words(ratio: float, error: float) -> str:
    """The error of a damping ratio by itself, in percent as `ratio_words` has it."""
    if not is_below_floor(error, ratio):
        return two_digits(100 * error)
    digits = _floor_digits(ratio)
    return f"below {10.0**-digits:.{digits}f}"


def _floor_digits(ratio: float) -> int:
    """Behind the point of a ratio in percent: as many as the next power of ten above the floor has."""
    return max(0, floor(-log10(FLOOR_PERCENT * abs(ratio))))


def is_below_floor(error: float, value: float) -> bool:
    """Whether nobody means it."""
    return 100 * error < FLOOR_PERCENT * abs(value)
