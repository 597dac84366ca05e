"""Numbers in sentences."""


def written_out(value: float, digits: int) -> str:
    """Some significant digits without an exponent: 97400 and not 9.74e+04."""
    return f"{float(f'{value:.{digits}g}'):g}"


def all_digits(value: float, digits: int) -> str:
    """So many significant digits, zeros at the end among them: 0.3030 beside 0.3275."""
    return f"{value:#.{digits}g}".rstrip(".")


def two_digits(value: float) -> str:
    """The same of two: 630 and not 6.3e+02; a share of 99.8 is 100."""
    return written_out(value, 2)
