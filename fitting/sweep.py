"""A measured sweep: the pickup's velocity at single frequencies, and what it was excited with.

Where a force drives, the fields of the base's acceleration hold newtons.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Indices, Integers, Mask

_GAP = 1.5
"""Where no segment is named, a step in frequency by this ratio begins a new one."""
_FAR = 1.1
"""Ratio from which a reference is of another level than was commanded, or than a file without levels has it:
less tells nothing of strain. A choice."""


@dataclass(frozen=True)
class Sweep:
    """Points of a sweep; every array has shape (points,) and its order carries no meaning."""

    frequency_hz: Array
    velocity_m_s: NDArray[Any]
    """Complex phasors, or real amplitudes where phase was not kept."""
    commanded_m_s2: Array
    """Base acceleration asked for."""
    segment: Integers
    sweep: Integers
    base_m_s2: Complex | None = None
    """Base acceleration measured, phasors."""
    std_m_s: Array | None = None
    """Standard deviation of the reading (of each part of a phasor), where the file states it."""
    weight: Array | None = None
    time_s: Array | None = None
    pickup: Integers | None = None
    """Which of several spots each point is of, from 0; None where there is one."""
    drive_limited: Mask | None = None
    """Where the drive's limit kept the base from the level asked for: no channel is off there."""
    std_of_dwells: bool = False
    """Whether `std_m_s` was seen within each dwell by whoever measured, not stated in a file."""

    def __len__(self) -> int:
        return len(self.frequency_hz)

    @property
    def has_phase(self) -> bool:
        """Whether velocities are phasors."""
        return bool(np.iscomplexobj(self.velocity_m_s))

    @property
    def omega(self) -> Array:
        """rad/s."""
        return 2 * np.pi * self.frequency_hz

    @property
    def relative_weight(self) -> Array:
        """Their mean square is one: they choose, they do not change the noise. Shape (points,)."""
        weight = np.ones(len(self)) if self.weight is None else self.weight
        return np.asarray(weight / np.sqrt(np.mean(weight**2)))

    @property
    def level_m_s2(self) -> Array:
        """Base acceleration asked for; as measured where that is far off, or the drive's limit kept it."""
        if self.base_m_s2 is None:
            return self.commanded_m_s2
        read = np.abs(self.base_m_s2)
        with np.errstate(divide="ignore"):
            far = np.abs(np.log(read / self.commanded_m_s2)) > np.log(_FAR)
        limited = False if self.drive_limited is None else self.drive_limited
        return np.where(far | limited, read, self.commanded_m_s2)

    @cached_property
    def response_m_s(self) -> NDArray[Any]:
        """Velocity over measured base acceleration times the commanded one, where there is a reference."""
        if self.base_m_s2 is None:
            return self.velocity_m_s
        base = self.base_m_s2 if self.has_phase else np.abs(self.base_m_s2)
        return np.asarray(self.velocity_m_s / base * self.commanded_m_s2)

    @cached_property
    def response_std_m_s(self) -> Array | None:
        """Stated standard deviation, carried over to `response_m_s`."""
        if self.std_m_s is None or self.base_m_s2 is None:
            return self.std_m_s
        return np.asarray(self.std_m_s / np.abs(self.base_m_s2) * self.commanded_m_s2)

    def take(self, points: Indices | Mask) -> "Sweep":
        """Some of the points."""
        arrays: dict[str, Any] = {
            name: value[points]
            for name, value in ((f, getattr(self, f)) for f in self.__dataclass_fields__)
            if isinstance(value, np.ndarray)
        }
        return replace(self, **arrays)

    def thinned(self, most: int) -> "Sweep":
        """At most so many of the points, spread over all, the lowest and the highest frequency among them."""
        if len(self) <= most:
            return self
        order = np.argsort(self.frequency_hz, kind="stable")
        return self.take(order[np.linspace(0, len(self) - 1, most).astype(int)])


def segments_by_gap(frequency_hz: Array) -> Integers:
    """Number the resonance regions where no segment is named. Shape (points,), counted from 1."""
    order = np.argsort(frequency_hz)
    ratio = frequency_hz[order][1:] / frequency_hz[order][:-1]
    number = np.concatenate([[1], 1 + np.cumsum(ratio > _GAP)])
    segment = np.empty(len(frequency_hz), dtype=np.intp)
    segment[order] = number
    return segment


def resonance_points(sweep: Sweep) -> Mask:
    """The point of largest response in each segment. Shape (points,)."""
    size = np.abs(sweep.response_m_s) / sweep.commanded_m_s2
    peak = np.zeros(len(sweep), dtype=bool)
    for number in np.unique(sweep.segment):
        inside = np.flatnonzero(sweep.segment == number)
        peak[inside[np.argmax(size[inside])]] = True
    return peak
