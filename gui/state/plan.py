"""Segments and steps of a sweep, done and planned."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from instrument.check.piece import Region
from instrument.files.experiment_file import SweepTable
from instrument.stream.derived import PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import SegmentBegan, SegmentEnded


@dataclass
class Plan:
    """Follows one sweep."""

    sweep: SweepTable | None
    begun: dict[tuple[int, int], SegmentBegan] = field(default_factory=dict)
    """By sweep and segment; sweep 0 is the calibration."""
    ended: set[tuple[int, int]] = field(default_factory=set)
    done: dict[tuple[int, int], int] = field(default_factory=dict)
    """Steps measured."""
    foreseen: tuple[Region, ...] = ()
    """What the run said before it began; empty of a recording."""

    def take(self, event: Event) -> None:
        """One event of the stream."""
        match event:
            case SegmentBegan():
                self.begun[event.sweep, event.segment] = event
            case SegmentEnded():
                self.ended.add((event.sweep, event.segment))
            case PointMeasured() if event.purpose in ("step", "calibration"):
                key = event.sweep, event.segment
                self.done[key] = self.done.get(key, 0) + 1

    @property
    def segments(self) -> int:
        """Planned, of all sweeps."""
        return len(self.sweep.segments) * self.sweep.sweeps if self.sweep is not None else 0

    @property
    def regions(self) -> tuple[Region, ...]:
        """Of every segment, begun or not, as far as they are known."""
        found = {number: (number, low, high) for number, low, high in (*self._stated(), *self.foreseen)}
        for (sweep, number), began in self.begun.items():
            if sweep > 0:
                found[number] = number, began.low_hz, began.high_hz
        return tuple(found[number] for number in sorted(found))

    def _stated(self) -> Iterator[Region]:
        """Where the file has frequencies, and not a mode."""
        for number, one in enumerate(self.sweep.segments if self.sweep is not None else (), start=1):
            if one.frequencies_hz is not None:
                yield number, min(one.frequencies_hz), max(one.frequencies_hz)
            elif one.low_hz is not None and one.high_hz is not None:
                yield number, one.low_hz, one.high_hz

    def fraction(self, key: tuple[int, int]) -> float:
        """Of one segment, 0 to 1."""
        if key in self.ended:
            return 1.0
        began = self.begun.get(key)
        return min(1.0, self.done.get(key, 0) / max(1, began.steps)) if began is not None else 0.0
