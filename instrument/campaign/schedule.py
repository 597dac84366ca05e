"""The points of a sweep, and when each is read."""

from dataclasses import dataclass

from fitting.arrays import Array, Integers


@dataclass(frozen=True)
class Schedule:
    """Points in the order of their frequencies, pass by pass. Shape (points,) each."""

    frequency_hz: Array
    segment: Integers
    sweep: Integers
    """Number of the pass, in order of time: one segment at one level."""
    level_g: Array
    time_s: Array
    """When the point was read."""
