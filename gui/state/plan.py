"""Segments and steps of a sweep, done and planned, and the time that is left."""

from collections.abc import Callable
from dataclasses import dataclass, field

from instrument.files.experiment_file import SweepTable
from instrument.stream.derived import PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import SegmentBegan, SegmentEnded

_Share = Callable[[tuple[int, int]], float]
_LEAST_STEPS = 3
"""So many steps before a pace is believed."""


@dataclass
class Plan:
    """Follows one sweep."""

    sweep: SweepTable | None
    forecast_s: dict[int, float] = field(default_factory=dict)
    """Seconds forecast for each segment by its number; empty where there is no forecast."""
    begun: dict[tuple[int, int], SegmentBegan] = field(default_factory=dict)
    """By sweep and segment; sweep 0 is the calibration."""
    ended: set[tuple[int, int]] = field(default_factory=set)
    done: dict[tuple[int, int], int] = field(default_factory=dict)
    """Steps measured."""
    _began_s: float | None = None
    _now_s: float = 0.0

    def take(self, event: Event, now_s: float) -> None:
        """One event of the stream, and when."""
        self._now_s = now_s
        match event:
            case SegmentBegan():
                self.begun[event.sweep, event.segment] = event
                if event.sweep > 0 and self._began_s is None:
                    self._began_s = now_s
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

    @property
    def progress(self) -> float:
        """Of the whole sweep, 0 to 1; a segment weighs the time forecast for it, else all weigh the same."""
        whole = self._seconds(lambda key: 1.0)
        return self._seconds(self.fraction) / whole if whole > 0 else 0.0

    @property
    def left_s(self) -> float | None:
        """At the pace so far; None without a forecast."""
        if not self.forecast_s or self.sweep is None:
            return None
        done = self._seconds(self.fraction)
        left = self._seconds(lambda key: 1.0) - done
        steps = sum(n for (sweep, _), n in self.done.items() if sweep > 0)
        if steps < _LEAST_STEPS or self._began_s is None or done <= 0:
            return left
        return left * (self._now_s - self._began_s) / done

    def _seconds(self, share: _Share) -> float:
        if self.sweep is None:
            return 0.0
        return sum(
            self.forecast_s.get(segment, 1.0) * share((turn, segment))
            for turn in range(1, self.sweep.sweeps + 1)
            for segment in range(1, len(self.sweep.segments) + 1)
        )
