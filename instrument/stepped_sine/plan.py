"""The order of a sweep: a generator of what comes next, which is told what each step gave.

It knows no device: walked with made-up results it is the dry run.
"""

from collections.abc import Callable, Collection, Generator
from dataclasses import dataclass, field, replace

from instrument.stepped_sine.drive import DriveModel
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import LoopChecked, PointMeasured, StepsChosen
from instrument.stream.raw import (
    ChoiceStarted,
    PlanOverruled,
    Purpose,
    SegmentBegan,
    SegmentEnded,
    StepBegan,
    StepDeclined,
)


@dataclass(frozen=True)
class RangeWanted:
    """The vibrometer's range for what follows."""

    name: str


@dataclass(frozen=True)
class ChoiceWanted:
    """What a sweep that chooses its own steps decided under a number, once it is there."""

    number: int


@dataclass(frozen=True)
class WordWanted:
    """What a person says to the steps chosen under a number, where anybody has said anything."""

    number: int


@dataclass(frozen=True)
class PlannedSegment:
    """A resonance region of one sweep."""

    segment: int
    sweep: int
    frequencies_hz: tuple[float, ...]
    level_m_s2: tuple[float, ...]
    """Of each frequency."""
    range_name: str
    purpose: Purpose = "step"


@dataclass(frozen=True)
class Done:
    """What a run that was broken off has behind it."""

    points: tuple[PointMeasured, ...] = ()
    declined: tuple[StepDeclined, ...] = ()

    def is_declined(self, planned: PlannedSegment, frequency_hz: float) -> bool:
        """Whether a person would not have a step."""
        wanted = (planned.segment, planned.sweep, frequency_hz)
        return planned.purpose == "step" and any(
            (d.segment, d.sweep, d.frequency_hz) == wanted for d in self.declined
        )

    def settles(self, planned: PlannedSegment, frequency_hz: float) -> bool:
        """Whether nothing is left to do about a step."""
        return self.find(planned, frequency_hz) is not None or self.is_declined(planned, frequency_hz)

    def find(self, planned: PlannedSegment, frequency_hz: float) -> PointMeasured | None:
        """The point of a step, where it is there already."""
        wanted = (planned.purpose, planned.segment, planned.sweep, frequency_hz)
        for p in self.points:
            same_range = planned.purpose != "calibration" or p.range_name == planned.range_name
            if (p.purpose, p.segment, p.sweep, p.frequency_hz) == wanted and same_range:
                return p
        return None


Action = RangeWanted | SegmentBegan | StepBegan | SegmentEnded | ChoiceStarted | ChoiceWanted | WordWanted
Result = LoopChecked | PointMeasured | StepsChosen | PlanOverruled | StepDeclined | None
Plan = Generator[Action, Result, None]


@dataclass
class Planner:
    """What a plan draws on."""

    settings: SweepSettings
    decay_1_s: Callable[[float], float]
    """Of the slowest transient expected at a frequency, as known at this moment."""
    sentinel: tuple[float, str] | None = None
    """Frequency and range; its level is the first segment's."""
    next_step: int = 1
    done: Done = field(default_factory=Done)
    drive: DriveModel = field(default_factory=DriveModel)
    _regions: tuple[PlannedSegment, ...] = ()
    _sentinels: int = 0

    def plan(self, segments: Collection[PlannedSegment]) -> Plan:
        """Segments in order, the sentinel before the first and after each."""
        self._regions, self._sentinels = tuple(segments), 0
        for k, planned in enumerate(segments):
            if k == 0:
                yield from self._watch(planned)
            yield from self._segment(planned)
            yield from self._watch(planned)

    def _segment(self, planned: PlannedSegment) -> Plan:
        f = planned.frequencies_hz
        if all(self.done.settles(planned, x) for x in f):
            return
        yield RangeWanted(planned.range_name)
        yield SegmentBegan(planned.segment, planned.sweep, min(f), max(f), len(f))
        for frequency, level in zip(f, planned.level_m_s2, strict=True):
            if not self.done.settles(planned, frequency):
                yield from self._step(planned, planned.purpose, frequency, level)
        yield SegmentEnded(planned.segment, planned.sweep)

    def _watch(self, planned: PlannedSegment) -> Plan:
        """The sentinel frequency once more, where there is one and it is not measured yet."""
        if self.sentinel is None or planned.purpose == "calibration":
            return
        self._sentinels += 1
        if sum(p.purpose == "sentinel" for p in self.done.points) >= self._sentinels:
            return
        frequency, range_name = self.sentinel
        yield RangeWanted(range_name)
        # It belongs to the region its frequency lies in, and is held out with it.
        near = [s for s in self._regions if min(s.frequencies_hz) <= frequency <= max(s.frequencies_hz)]
        region = replace(near[0] if near else planned, sweep=planned.sweep)
        yield from self._step(region, "sentinel", frequency, planned.level_m_s2[0])

    def _step(
        self, planned: PlannedSegment, purpose: Purpose, frequency: float, level: float
    ) -> Generator[Action, Result, bool]:
        """Whether it was measured: a person may decline it."""
        if not self.drive.knows(frequency):
            check = self.settings.control.check_share * self.settings.limits.drive_v
            found = yield self._began(planned, "loop-check", frequency, None, check)
            if isinstance(found, StepDeclined):
                return False
            if isinstance(found, LoopChecked):
                self.drive.learn(frequency, found.gain_m_s2_v)
        drive = min(self.drive.drive_v(frequency, level), self.settings.limits.drive_v)
        point = yield self._began(planned, purpose, frequency, level, drive)
        if isinstance(point, PointMeasured) and point.drive_v > 0:
            self.drive.learn(frequency, abs(point.base_m_s2) / point.drive_v)
        return not isinstance(point, StepDeclined)

    def _began(
        self, planned: PlannedSegment, purpose: Purpose, frequency: float, level: float | None, drive: float
    ) -> StepBegan:
        number, self.next_step = self.next_step, self.next_step + 1
        return StepBegan(
            number,
            purpose,
            planned.segment,
            planned.sweep,
            frequency,
            level,
            drive,
            self.decay_1_s(frequency),
        )
