"""A session file indexed: where on its timeline each event stands, and the state at any place. No Qt.

The timeline is the session's clock, without the time that lay between a break and its continuation.
"""

from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from gui.state import SessionState
from instrument.session.configuration import Configuration
from instrument.session.storage import SessionFile
from instrument.stream.clock import SessionClock
from instrument.stream.event import Event
from instrument.stream.raw import AcquisitionBegan, BlockAcquired, SegmentBegan, StepBegan

_MOST_GAP_S = 2.0
"""Longer pauses between two acquisitions are cut to this."""
Look = Callable[[], None]
"""Called now and then during long work; raises where the work is no longer wanted."""


@dataclass(frozen=True)
class IndexMark:
    """A place worth jumping to."""

    time_s: float
    what: str


@dataclass(frozen=True)
class SessionIndex:
    """The index of a session; events are read again when they are wanted.

    Attributes
    ----------
    time_s : tuple of float
        Of each event on the timeline; never falls.
    part_first : tuple of int
        Number of each part's first event.
    with_blows : tuple of bool
        Whether the part belongs to a hammer test.
    step_first : tuple of int
        Numbers of the events from which on samples belong to a new step.
    """

    path: Path
    configuration: Configuration
    time_s: tuple[float, ...]
    part_first: tuple[int, ...]
    with_blows: tuple[bool, ...]
    step_first: tuple[int, ...]
    marks: tuple[IndexMark, ...]

    @classmethod
    def of(cls, file: SessionFile, look: Look) -> "SessionIndex":
        """Read a session once without its samples. Raises `BadInput`."""
        times: list[float] = []
        firsts: list[int] = []
        blows: list[bool] = []
        steps: list[int] = []
        marks: list[IndexMark] = []
        timeline, hammer = _Timeline(), False
        for number in range(file.part_count):
            look()
            firsts.append(len(times))
            blows.append(hammer)
            for event in file.part(number, with_samples=False):
                times.append(timeline.take(event))
                if isinstance(event, AcquisitionBegan):
                    hammer = event.part in ("hammer", "struck")
                    blows[-1] |= hammer
                if isinstance(event, StepBegan | AcquisitionBegan):
                    steps.append(len(times) - 1)
                if (what := _worth_a_mark(event)) is not None:
                    marks.append(IndexMark(times[-1], what))
        return cls(
            file.path,
            file.configuration,
            tuple(times),
            tuple(firsts),
            tuple(blows),
            tuple(steps),
            tuple(marks),
        )

    @property
    def length_s(self) -> float:
        """Length of the timeline."""
        return self.time_s[-1] if self.time_s else 0.0

    def count_at(self, time_s: float) -> int:
        """Events up to a time, itself included."""
        return bisect_right(self.time_s, time_s)

    def events(self, file: SessionFile, first: int) -> Iterator[tuple[int, Event]]:
        """Events with their samples and numbers, from one on."""
        for part in range(self._part(first), len(self.part_first)):
            yield from self._part_events(file, part, first, with_samples=True)

    def state(self, file: SessionFile, count: int, look: Look) -> SessionState:
        """The state after so many events. Samples are read only where the state keeps them."""
        state = SessionState(self.configuration, self.path)
        step = self.step_first[bisect_right(self.step_first, count - 1) - 1] if self.step_first else 0
        for part in range(self._part(count - 1) + 1 if count else 0):
            look()
            needed = self.with_blows[part] or part >= self._part(step)
            for number, event in self._part_events(file, part, 0, with_samples=needed):
                if number >= count:
                    break
                state.take(event)
        return state

    def _part(self, number: int) -> int:
        return max(0, bisect_right(self.part_first, number) - 1)

    def _part_events(
        self, file: SessionFile, part: int, first: int, *, with_samples: bool
    ) -> Iterator[tuple[int, Event]]:
        begin = self.part_first[part]
        for k, event in enumerate(file.part(part, with_samples=with_samples), start=begin):
            if k >= first:
                yield k, event


class _Timeline:
    def __init__(self) -> None:
        self._clock = SessionClock()
        self._session_s = self._time_s = 0.0

    def take(self, event: Event) -> float:
        """Where the event stands."""
        self._clock.take(event)
        if isinstance(event, BlockAcquired):
            now = self._clock.at(event.first_sample + event.samples)
            begun = self._clock.at(event.first_sample)
            pause = min(max(0.0, begun - self._session_s), _MOST_GAP_S)
            self._time_s += pause + max(0.0, now - max(begun, self._session_s))
            self._session_s = max(now, self._session_s)
        return self._time_s


_PARTS = {"hammer": "hammer test", "calibration": "calibration", "struck": "damped plate struck"}


def _worth_a_mark(event: Event) -> str | None:
    match event:
        case AcquisitionBegan() if event.part != "sweep":
            return _PARTS[event.part]
        case SegmentBegan() if event.sweep > 0:
            return f"segment {event.segment}" + (f", sweep {event.sweep}" if event.sweep > 1 else "")
    return None
