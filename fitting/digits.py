"""Numbers in sentences."""


def two_digits(value: float) -> str:
    """Two significant digits, written out: 630 and not 6.3e+02; a share of 99.8 is 100."""
    return f"{float(f'{value:.2g}'):g}"
