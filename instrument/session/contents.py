"""What a session holds, gathered from its events in one pass."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from fitting.structures import AnySpecimen
from instrument.errors import BadInput
from instrument.files.rig_file import Channels
from instrument.impact.judge import Judged, judge
from instrument.impact.record import Hit, ResponseChannel
from instrument.session.configuration import Configuration
from instrument.session.storage import SessionFile
from instrument.stream.clock import SessionClock
from instrument.stream.derived import (
    CalibrationFound,
    DampingFound,
    DiagnosisFound,
    FitUpdated,
    HitJudged,
    HitRevised,
    LimitExceeded,
    LimitWarned,
    PointMeasured,
    SentinelCompared,
    StruckFound,
)
from instrument.stream.event import Event
from instrument.stream.raw import (
    AcquisitionBegan,
    BlockAcquired,
    FollowUpDecided,
    FollowUpProposed,
    OperatorDid,
    RangeSet,
    SegmentBegan,
    SegmentEnded,
    SessionBegan,
    SessionEnded,
    SoakEnded,
    TemperatureRead,
)
from instrument.stream.scaling import Scaling

_LONGEST_RECORD_S = 400.0
"""No record of a hit is longer; older samples are let go of however long nobody strikes."""


@dataclass(frozen=True)
class TimedPoint:
    """A point of the sweep and when it was read."""

    point: PointMeasured
    time_s: float
    """Since the session's first sample; across a break as the clock had it."""


@dataclass(frozen=True)
class RecordedHit:
    """A blow as it was caught, in units, nothing set right."""

    number: int
    accepted: bool
    """Whether it counts; the operator's word overrules the judgement."""
    why: str
    peak_n: float
    record: Hit

    def judged(self) -> Judged:
        """Set right as it was for the hammer test."""
        found = judge(self.record)
        why = self.why if self.accepted else self.why or "rejected"
        return Judged(found.hit, self.accepted, why, found.notes, found.pulse)


@dataclass(frozen=True)
class SegmentRun:
    """A segment that was begun."""

    segment: int
    sweep: int
    """0 for calibration."""
    low_hz: float
    high_hz: float
    steps: int
    """Planned."""
    ended: bool


@dataclass
class Contents:
    """Everything a report, an export or an identification asks of a session."""

    path: Path
    configuration: Configuration
    began: list[SessionBegan] = field(default_factory=list)
    """Several where the run was broken off and resumed."""
    ended: SessionEnded | None = None
    """None where the program was killed."""
    sample_rate_hz: float | None = None
    """Sample rate of the sweep."""
    points: list[TimedPoint] = field(default_factory=list)
    """Steps and sentinels, as they were measured."""
    segments: dict[tuple[int, int], SegmentRun] = field(default_factory=dict)
    """By sweep and segment; calibration not among them."""
    calibrations: dict[str, CalibrationFound] = field(default_factory=dict)
    calibration_points: list[PointMeasured] = field(default_factory=list)
    sentinels: list[SentinelCompared] = field(default_factory=list)
    hits: list[RecordedHit] = field(default_factory=list)
    """Of the last hammer test; empty where contents were gathered without samples."""
    hammer_rate_hz: float | None = None
    damping: DampingFound | None = None
    struck: list[StruckFound] = field(default_factory=list)
    """What blows on the treated plate gave."""
    struck_hits: list[RecordedHit] = field(default_factory=list)
    """The last time it was struck; empty where contents were gathered without samples."""
    fit: FitUpdated | None = None
    """The last one of the run itself."""
    diagnosis: DiagnosisFound | None = None
    """The last diagnosis of the run."""
    following: list[Event] = field(default_factory=list)
    """Every diagnosis, and what was proposed and decided after it."""
    limits: list[LimitWarned | LimitExceeded] = field(default_factory=list)
    operator: list[OperatorDid] = field(default_factory=list)
    temperatures: list[TemperatureRead] = field(default_factory=list)
    """Of the chamber or thermometer, before the steps; those of a soak are not among them."""
    soaks: list[SoakEnded] = field(default_factory=list)

    @property
    def specimen(self) -> AnySpecimen:
        """The session's own, read as its rig's laser does. Raises `OutsideModel`."""
        return self.configuration.the_specimen()

    @property
    def measured(self) -> list[PointMeasured]:
        """The sweep's points without their times."""
        return [p.point for p in self.points]

    @property
    def good_hits(self) -> list[RecordedHit]:
        """Hits that count."""
        return [h for h in self.hits if h.accepted]


def contents_of(session: SessionFile, *, with_hits: bool = True) -> Contents:
    """Gather a session. Without hits no samples are read. Raises `BadInput` where the file is damaged."""
    gather = Gather(Contents(session.path, session.configuration), with_hits)
    for event in session.events(with_samples=with_hits):
        gather.take(event)
    return gather.contents


class Gather:
    """Fills contents event by event, whether a session is read or still being run."""

    def __init__(self, contents: Contents, with_hits: bool) -> None:
        self.contents = contents
        self._clock = SessionClock()
        self._tape = _Tape(contents.configuration.rig.channels) if with_hits else None
        self.hits = contents.hits
        """Where the next one goes: of the test that goes on."""

    def take(self, event: Event) -> None:
        """One event into its place. Raises `BadInput` for a hit whose samples are missing."""
        c = self.contents
        self._clock.take(event)
        if self._tape is not None:
            self._tape.take(event)
        match event:
            case SessionBegan():
                c.began.append(event)
                c.ended = None
            case SessionEnded():
                c.ended = event
            case AcquisitionBegan():
                self._acquire(event)
            case SegmentBegan() | SegmentEnded():
                self._segment(event)
            case PointMeasured() if event.purpose == "calibration":
                c.calibration_points.append(event)
            case PointMeasured():
                c.points.append(TimedPoint(event, self._clock.at(event.sample)))
            case HitJudged() | HitRevised():
                self._hit(event)
            case _:
                self._keep(event)

    def _keep(self, event: Event) -> None:
        c = self.contents
        match event:
            case CalibrationFound():
                c.calibrations[event.range_name] = event
            case SentinelCompared():
                c.sentinels.append(event)
            case DampingFound():
                c.damping = event
            case StruckFound():
                c.struck = event.added_to(c.struck)
            case FitUpdated():
                c.fit = event
            case DiagnosisFound():
                c.diagnosis = event
                c.following.append(event)
            case FollowUpProposed() | FollowUpDecided():
                c.following.append(event)
            case LimitWarned() | LimitExceeded():
                c.limits.append(event)
            case OperatorDid():
                c.operator.append(event)
            case TemperatureRead() if event.soak_s is None:
                c.temperatures.append(event)
            case SoakEnded():
                c.soaks.append(event)

    def _acquire(self, event: AcquisitionBegan) -> None:
        # A test that was broken off begins again: its hits are numbered from 1.
        if event.part == "struck":
            self.hits = self.contents.struck_hits = []
        elif event.part == "hammer":
            self.hits = self.contents.hits = []
            self.contents.hammer_rate_hz = event.sample_rate_hz
        elif event.part == "sweep":
            self.contents.sample_rate_hz = event.sample_rate_hz

    def _segment(self, event: SegmentBegan | SegmentEnded) -> None:
        if event.sweep == 0:
            return
        key, runs = (event.sweep, event.segment), self.contents.segments
        if isinstance(event, SegmentBegan):
            runs[key] = SegmentRun(
                event.segment, event.sweep, event.low_hz, event.high_hz, event.steps, ended=False
            )
        elif key in runs:
            runs[key] = SegmentRun(**{**vars(runs[key]), "ended": True})

    def _hit(self, event: HitJudged | HitRevised) -> None:
        hits = self.hits
        if isinstance(event, HitRevised):
            hits[:] = [
                RecordedHit(**{**vars(h), "accepted": event.accepted}) if h.number == event.hit else h
                for h in hits
            ]
        elif self._tape is not None:
            record = self._tape.cut(event)
            hits.append(RecordedHit(event.hit, event.accepted, event.why, event.peak_n, record))


class _Tape:
    """Samples of a test with the hammer from the last hit on."""

    def __init__(self, sensors: Channels) -> None:
        self._sensors = sensors
        self._range: RangeSet | None = None
        self._acquisition: AcquisitionBegan | None = None
        self._blocks: list[BlockAcquired] = []

    def take(self, event: Event) -> None:
        if isinstance(event, RangeSet):
            self._range = event
        elif isinstance(event, AcquisitionBegan):
            strikes = event.part in ("hammer", "struck")
            self._acquisition, self._blocks = (event if strikes else None), []
        elif isinstance(event, BlockAcquired) and self._acquisition is not None:
            if self._blocks and _end(self._blocks[-1]) != event.first_sample:
                # Blocks were lost on the way here: no record may reach across them.
                self._blocks = []
            self._blocks.append(event)
            kept = event.first_sample - _LONGEST_RECORD_S * self._acquisition.sample_rate_hz
            while _end(self._blocks[0]) < kept:
                self._blocks.pop(0)

    def cut(self, hit: HitJudged) -> Hit:
        """The samples of a hit."""
        end = hit.first_sample + hit.samples
        blocks = self._blocks
        if self._acquisition is None or not blocks or not _inside(hit.first_sample, end, blocks):
            raise BadInput(f"hit {hit.hit}: its samples are missing, expected them before its verdict")
        volts = np.concatenate([b.volts for b in self._blocks], axis=1)
        start = hit.first_sample - self._blocks[0].first_sample
        record = volts[:, start : start + hit.samples]
        # Records do not overlap: what lies before the end of this one is done with.
        self._blocks = [b for b in self._blocks if _end(b) > end]
        scaling = Scaling.of(self._acquisition.channels, self._sensors.named())
        if self._acquisition.part == "struck" and self._range is not None:
            force = scaling.units("force", record)
            velocity = scaling.velocity(record, self._range.scale_m_s_v)
            response = ResponseChannel("velocity", "velocity", velocity)
        else:
            force, acceleration = scaling.blow(record)
            response = ResponseChannel("response", "acceleration", acceleration)
        return Hit(f"hit {hit.hit}", self._acquisition.sample_rate_hz, force, (response,))


def _inside(first: int, end: int, blocks: list[BlockAcquired]) -> bool:
    return blocks[0].first_sample <= first and end <= _end(blocks[-1])


def _end(block: BlockAcquired) -> int:
    return block.first_sample + block.samples
