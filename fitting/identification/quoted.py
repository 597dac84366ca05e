"""Where a law is quoted in numbers."""

from collections.abc import Iterable

import numpy as np

REFERENCE_FREQUENCIES_HZ = (20.0, 100.0, 280.0)
"""Where the band is always stated, as far as they lie inside the measured range."""
_FEWEST = 2
"""Of them inside: one frequency says nothing of how the law goes on, none says nothing."""


def quoted_hz(listed_hz: Iterable[float]) -> tuple[float, ...]:
    """The reference frequencies in the range of a list; with fewer than two, its ends and middle too.

    Returns them ascending. Who lists a law lists its references as well.
    """
    f = np.unique(np.fromiter(listed_hz, dtype=float))
    if not len(f):
        return ()
    quoted = {r for r in REFERENCE_FREQUENCIES_HZ if f[0] <= r <= f[-1]}
    if len(quoted) < _FEWEST:
        quoted |= {float(f[0]), float(f[len(f) // 2]), float(f[-1])}
    return tuple(sorted(quoted))
