"""Error on data the fit has not seen: one point at a time, or whole segments where there are many."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Mask
from fitting.progress import Report, unheard

Learnt = Callable[[Mask], Array]
"""Points to learn from, to 100 (|predicted| - |measured|)/|measured| at every point."""

MOST_POINTS_ONE_BY_ONE = 30
"""As many fits: of more points neighbours tell each other, and a segment is held out."""


@dataclass(frozen=True)
class HeldOutSegment:
    """A segment predicted from the others."""

    segment: int
    rms_percent: float
    noise_percent: float
    """Rms of the noise over the reading; NaN where it is not known."""


@dataclass(frozen=True)
class Validation:
    """Either figure is None where it does not apply."""

    leave_one_out_rms_percent: float | None = None
    held_out: tuple[HeldOutSegment, ...] = ()
    held_out_rms_percent: float | None = None

    @property
    def without_noise(self) -> "Validation":
        """The same where nobody knows the noise."""
        return replace(self, held_out=tuple(replace(h, noise_percent=float("nan")) for h in self.held_out))


def validate(
    segment: NDArray[np.intp],
    points_needed: int,
    differences_percent: Learnt,
    noise_percent: Array,
    progress: Report = unheard,
) -> Validation:
    """Leave-one-out up to 30 points, else every segment from the others. Shape (points,)."""
    count = len(segment)
    if count <= MOST_POINTS_ONE_BY_ONE:
        if count - 1 < points_needed:
            return Validation()
        left_out = np.empty(count)
        for k in range(count):
            left_out[k] = differences_percent(np.arange(count) != k)[k]
            progress((k + 1) / count)
        return Validation(leave_one_out_rms_percent=rms(left_out))
    numbers = np.unique(segment)
    if len(numbers) < 2:
        return Validation()
    held_out: list[HeldOutSegment] = []
    all_differences = np.empty(count)
    for number in numbers:
        inside = segment == number
        all_differences[inside] = differences_percent(~inside)[inside]
        progress(len(held_out) / len(numbers))
        held_out.append(HeldOutSegment(int(number), rms(all_differences[inside]), rms(noise_percent[inside])))
    return Validation(held_out=tuple(held_out), held_out_rms_percent=rms(all_differences))


def rms(values: Array) -> float:
    """Root mean square over all of an array of any shape."""
    return float(np.sqrt(np.mean(np.square(values))))
