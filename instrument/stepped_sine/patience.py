"""Which `most_s` a plate that decays slowly needs."""

import numpy as np

LONGEST_S = 300.0
"""The most that a file may ask for: a step of five minutes is no sweep."""
_ROOM = 2.0
"""Times what is expected: on a simulated plate with a loss factor of 0.005 single steps took up to 1.5 times
that. Where a step settles earlier, room costs nothing."""
_ROUND_S = 5.0
"""Said in multiples of."""


def enough_s(longest_s: float) -> float:
    """`most_s` for steps of which the slowest is expected to settle in so many s, `LONGEST_S` at most."""
    return float(min(np.ceil(_ROOM * longest_s / _ROUND_S) * _ROUND_S, LONGEST_S))
