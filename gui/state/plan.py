"""Segments and steps of a sweep, done and planned."""

from dataclasses import dataclass, field

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

    def fraction(self, key: tuple[int, int]) -> float:
        """Of one segment, 0 to 1."""
        if key in self.ended:
            return 1.0
        began = self.begun.get(key)
        return min(1.0, self.done.get(key, 0) / max(1, began.steps)) if began is not None else 0.0
