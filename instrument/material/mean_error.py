"""How well the mean of several laws is known: by their scatter, and by what the scatter cannot show.

    var = max(t^2 / 1.96^2 * sum w (y - m)^2 / ((n - 1) sum w), sum p^2 (s^2 - c^2)) + (sum p c)^2

w = 1 / (s^2 + tau^2) are the weights of the mean m, p = w / sum w. The first term is that of Hartung and
Knapp (Statistics in Medicine 20, 2001): what the laws scatter by, with Student's t for so few of them. It is
no less than what noise alone leaves. c is the part of each error s that comes of stated numbers which other
laws state too: all are moved the same way by them, which no scatter shows and no number of laws takes away.
The last term is a sum over laws of one specimen's numbers, squared, and added up over such specimens.
"""

from collections.abc import Sequence

import numpy as np
from scipy.special import stdtrit

from fitting.arrays import Array
from fitting.numerics.chances import Z_95

_UPPER = 0.975
"""Of Student's t: two-sided 95 %."""


def mean_error(y: Array, error: Array, stated: Array, same: Sequence[str | None], spread: float) -> float:
    """Standard error of the weighted mean, 1.96 of which to either side hold the truth in 95 of 100.

    `y`, `error` and its part of stated numbers have shape (laws,). `same` says of each law which numbers it
    states; None shares them with no other.
    """
    w = 1 / (error**2 + spread**2)
    p = w / np.sum(w)
    n = len(y)
    scatter = float(np.sum(p * (y - np.sum(p * y)) ** 2) / (n - 1))
    few = float(stdtrit(n - 1, _UPPER)) / Z_95
    noise, shared = p**2 * error**2, 0.0
    for mine in _shared(same):
        noise[mine] -= (p * stated)[mine] ** 2
        shared += float(np.sum((p * stated)[mine])) ** 2
    return float(np.sqrt(max(few**2 * scatter, float(np.sum(noise))) + shared))


def _shared(same: Sequence[str | None]) -> list[list[int]]:
    """Places of laws that state the same numbers, two at least."""
    found: dict[str, list[int]] = {}
    for place, which in enumerate(same):
        if which is not None:
            found.setdefault(which, []).append(place)
    return [mine for mine in found.values() if len(mine) > 1]
