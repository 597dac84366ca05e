"""In which measurements the steps of one place are made: the same segments in several lengths, and more.

Hands cost minutes and a step about a second. What a person has set up may be read longer, between the
segments and about the plate's twists; what of it is worth its time the order says
(`instrument.planning.order`).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.sweep import Sweep
from instrument.planning.steps import Steps

LENGTHS = (20, 40)
"""Steps of each segment that was measured. Fewer than 15 would not show their noise; twice as many as these
tell little more, since the model errs alike in them, and take a diagnosis minutes. A choice."""
MOST = LENGTHS[-1]


@dataclass(frozen=True)
class Choice:
    """Steps of a place that make one measurement."""

    at: NDArray[np.intp]
    """Of all steps of the place, in the order in which they are made. Shape (steps,)."""
    words: str
    """What is done, in the imperative."""


@dataclass(frozen=True)
class Offered:
    """All steps that may be made at a place: the segments of before, the gaps between them, the twists."""

    same: Steps
    """With `MOST` steps a segment."""
    gaps: Steps
    twists: Steps
    twists_at: str = ""
    """Frequencies of these, in words."""

    @property
    def steps(self) -> Steps:
        """One after the other."""
        return self.same.then(self.gaps).then(self.twists)

    @property
    def known(self) -> NDArray[np.bool_]:
        """Which of them are of a segment that was measured. Shape (steps,)."""
        return np.arange(len(self.steps)) < len(self.same)

    def choices(self) -> Iterator[Choice]:
        """Every measurement with hands: the segments of before or the twists, or both, and the gaps."""
        about = f"measure its twist, about {self.twists_at} Hz"
        twists = np.arange(len(self.steps) - len(self.twists), len(self.steps))
        if len(twists):
            yield Choice(twists, about)
        for one in (*self.lengths(), *self.with_gaps()):
            yield one
            if len(twists):
                yield Choice(np.concatenate([one.at, twists]), f"{one.words}, and {about}")

    def lengths(self) -> Iterator[Choice]:
        """The segments of before, the shortest first."""
        for count in LENGTHS:
            yield Choice(_evenly(self.same.segment, count), f"sweep the same segments, {count} steps each")

    def with_gaps(self) -> Iterator[Choice]:
        """The `lengths`, and what lies between them."""
        gaps = len(self.same) + np.arange(len(self.gaps))
        for one in self.lengths() if len(gaps) else ():
            yield Choice(np.concatenate([one.at, gaps]), f"{one.words}, and between them")

    def each_gap(self) -> Iterator[Choice]:
        """Nothing else."""
        for number in np.unique(self.gaps.segment):
            at = np.flatnonzero(self.gaps.segment == number)
            f = self.gaps.frequency_hz[at]
            words = f"measure {len(at)} steps from {f[0]:.4g} to {f[-1]:.4g} Hz"
            yield Choice(len(self.same) + at, words)


def again(sweep: Sweep, time_s: Array) -> tuple[Array, NDArray[np.intp]]:
    """Frequencies and segments of `MOST` steps of each segment, in the order in which it was swept.

    They lie among its own as evenly as these do. `time_s`: when each point was read, shape (points,). Shape
    (steps,) each.
    """
    found = []
    for number in np.unique(sweep.segment):
        inside = np.flatnonzero(sweep.segment == number)
        its, first = np.unique(sweep.frequency_hz[inside], return_index=True)
        at = np.linspace(0, len(its) - 1, MOST if len(its) > 1 else 1)
        own = np.arange(len(its))
        f = np.round(np.interp(at, own, its), 4)
        found.append((np.interp(at, own, time_s[inside][first]), f, np.full(len(at), number)))
    time, f, segment = (np.concatenate(column) for column in zip(*found, strict=True))
    order = np.argsort(time, kind="stable")
    return f[order], segment[order]


def _evenly(segment: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """Places of so many steps of each segment, where it has as many. Shape (steps,)."""
    every = [np.flatnonzero(segment == number) for number in np.unique(segment)]
    return np.sort(
        np.concatenate(
            [its[np.unique(np.linspace(0, len(its) - 1, count).round().astype(int))] for its in every]
        )
    )
