"""The order of a sweep: a generator of what comes next, which is told what each step gave.

It knows no device: walked with made-up results it is the dry run.
"""

from collections.abc import Callable, Collection, Generator
from dataclasses import dataclass, field

from instrument.stepped_sine.drive import DriveModel
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import LoopChecked, PointMeasured
from instrument.stream.raw import Purpose, SegmentBegan, SegmentEnded, StepBegan


@dataclass(frozen=True)
class RangeWanted:
    """The vibrometer's range for what follows."""

    name: str


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

    def find(
        self, purpose: str, planned: PlannedSegment, frequency_hz: float, times: int
    ) -> PointMeasured | None:
        """The point, where it is there already: the `times`-th of its kind, counted from 0."""
        alike = [
            p
            for p in self.points
            if (p.purpose, p.segment, p.sweep, p.frequency_hz)
            == (purpose, planned.segment, planned.sweep, frequency_hz)
            and (planned.purpose != "calibration" or p.range_name == planned.range_name)
        ]
        return alike[times] if times < len(alike) else None


Action = RangeWanted | SegmentBegan | StepBegan | SegmentEnded
Result = LoopChecked | PointMeasured | None
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

    def plan(self, segments: Collection[PlannedSegment]) -> Plan:
        """Segments in order, the sentinel before the first and after each."""
        for k, planned in enumerate(segments):
            if k == 0:
                yield from self._watch(planned, times=0)
            yield from self._segment(planned)
            yield from self._watch(planned, times=1 if k == 0 else 0)

    def _segment(self, planned: PlannedSegment) -> Plan:
        f = planned.frequencies_hz
        if all(self.done.find(planned.purpose, planned, x, 0) for x in f):
            return
        yield RangeWanted(planned.range_name)
        yield SegmentBegan(planned.segment, planned.sweep, min(f), max(f), len(f))
        for frequency, level in zip(f, planned.level_m_s2, strict=True):
            if self.done.find(planned.purpose, planned, frequency, 0) is None:
                yield from self._step(planned, planned.purpose, frequency, level)
        yield SegmentEnded(planned.segment, planned.sweep)

    def _watch(self, planned: PlannedSegment, times: int) -> Plan:
        """The sentinel frequency, where there is one and it was not measured here `times` + 1 times."""
        if self.sentinel is None or planned.purpose == "calibration":
            return
        frequency, range_name = self.sentinel
        if self.done.find("sentinel", planned, frequency, times) is None:
            yield RangeWanted(range_name)
            yield from self._step(planned, "sentinel", frequency, planned.level_m_s2[0])

    def _step(self, planned: PlannedSegment, purpose: Purpose, frequency: float, level: float) -> Plan:
        if not self.drive.knows(frequency):
            check = self.settings.control.check_share * self.settings.limits.drive_v
            found = yield self._began(planned, "loop-check", frequency, None, check)
            if isinstance(found, LoopChecked):
                self.drive.learn(frequency, found.gain_m_s2_v)
        drive = min(self.drive.drive_v(frequency, level), self.settings.limits.drive_v)
        point = yield self._began(planned, purpose, frequency, level, drive)
        if isinstance(point, PointMeasured) and point.drive_v > 0:
            self.drive.learn(frequency, abs(point.base_m_s2) / point.drive_v)

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
