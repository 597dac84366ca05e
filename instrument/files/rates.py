"""A sample rate from the step between samples, which files write with few digits."""

CONTRADICTION = 2e-3
"""Relative, of two statements of one sample rate: times printed with few digits differ by less."""


def rate_of_step(step_s: float, relative: float) -> float:
    """Samples a second: of the rates the step leaves open, the one with the fewest digits.

    A universal file's step has six digits: 1.22070e-4 s is 8192 Hz, not 8192.02 Hz.
    """
    rate = 1 / step_s
    for digits in range(1, 16):
        simple = float(f"{rate:.{digits}g}")
        if abs(simple - rate) <= relative * rate:
            return simple
    return rate
