"""Numbers in sentences."""

from math import exp, floor, log

_WRITTEN = 1e4
"""Odds up to which they are written out: of larger ones the power of ten says enough."""
_SELDOM = 1e-6
"""Chance below which its size says nothing more."""
_TAIL = 1e-3
"""The same of a p-value: it rests on errors that are known to a few tens of percent."""


def written_out(value: float, digits: int) -> str:
    """Some significant digits without an exponent: 97400 and not 9.74e+04."""
    return f"{float(f'{value:.{digits}g}'):g}"


def all_digits(value: float, digits: int) -> str:
    """So many significant digits, zeros at the end among them: 0.3030 beside 0.3275."""
    return f"{value:#.{digits}g}".rstrip(".")


def two_digits(value: float) -> str:
    """Two significant digits as `written_out` has them: 630 and not 6.3e+02; a share of 99.8 is 100."""
    return written_out(value, 2)


def tail(chance: float, digits: int = 2) -> str:
    """A p-value: `0.12`; one too small for its size to say anything is `< 0.001`, and never 0."""
    return "< 0.001" if chance < _TAIL else f"{chance:.{digits}g}"


def band(low: float, high: float) -> str:
    """A range of frequencies in Hz, to four digits: `20 to 280 Hz`, and `478 Hz` where it is one."""
    one, other = f"{low:.4g}", f"{high:.4g}"
    return f"{one} Hz" if one == other else f"{one} to {other} Hz"


def seldom(chance: float) -> str:
    """How often what has a small chance happens: `once in 340 times`."""
    return (
        f"once in {written_out(1 / chance, 2)} times"
        if chance > _SELDOM
        else "once in more than a million times"
    )


def times(log_odds: float) -> str:
    """Natural logarithm of odds as how many times as likely one is as the other: 3 are `20 times`."""
    if log_odds < log(_WRITTEN):
        odds = exp(log_odds)
        return f"{odds:.1f} times" if odds < 10 else f"{two_digits(odds)} times"
    return f"over 10^{floor(log_odds / log(10))} times"
