"""What is known of a session so far: fed by events, drawn by pages. No Qt.

Rule: the same events give the same state, whether they come from a rig, a file or a replay. Everything a
session holds is in `contents`; beside it stands only what a person watching needs at this moment.
"""

from collections import Counter
from datetime import datetime
from pathlib import Path
from typing import Literal

import numpy as np

from gui.state.log import Kind, Log
from gui.state.plan import Plan
from gui.state.readings import Readings
from gui.state.run import Run
from gui.state.step import Step
from gui.state.time_to_go import TimeToGo
from instrument.check.piece import Region
from instrument.errors import BadInput
from instrument.impact.record import Hit, ResponseChannel
from instrument.results.event_words import Saying
from instrument.session.configuration import Configuration
from instrument.session.contents import Contents, Gather, RecordedHit
from instrument.session.setup import sweep_settings
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.clock import SessionClock
from instrument.stream.derived import (
    CalibrationFound,
    DampingFound,
    DiagnosisFound,
    DriveRequested,
    FitUpdated,
    HitJudged,
    HitRevised,
    LimitExceeded,
    LimitWarned,
    PointMeasured,
    RangeRequested,
    SentinelCompared,
    SettlingTimedOut,
    StepsChosen,
    StepSettled,
    StruckFound,
)
from instrument.stream.event import Event
from instrument.stream.raw import (
    AcquisitionBegan,
    BlockAcquired,
    DiagnosisStarted,
    FitFailed,
    FitStarted,
    FollowUpDecided,
    FollowUpEnded,
    FollowUpProposed,
    HammerTestEnded,
    Held,
    PlanOverruled,
    RangeSet,
    SegmentBegan,
    SegmentEnded,
    SessionBegan,
    SessionEnded,
    ShakerCommanded,
    SignalLevelRead,
    SoakBegan,
    SoakEnded,
    StepBegan,
    StepDeclined,
    TemperatureRead,
)
from instrument.stream.scaling import Scaling

Topic = Literal[
    "run", "step", "samples", "points", "hits", "damping", "calibration", "sentinels", "fits", "diagnosis",
    "limits", "log",
]  # fmt: skip
"""What a page can ask after; `SessionState.changed` counts for each how often it changed."""

_TOPICS: dict[type[Event], tuple[Topic, ...]] = {
    SessionBegan: ("run",),
    SessionEnded: ("run", "log"),
    AcquisitionBegan: ("run", "hits"),
    BlockAcquired: ("samples",),
    RangeSet: ("step",),
    SignalLevelRead: ("step",),
    SoakBegan: ("run",),
    TemperatureRead: ("run",),
    SoakEnded: ("run",),
    SegmentBegan: ("run",),
    SegmentEnded: ("run",),
    StepBegan: ("run", "step", "samples"),
    ShakerCommanded: ("step",),
    Held: ("run", "step"),
    DriveRequested: ("step",),
    RangeRequested: ("step",),
    StepSettled: ("step",),
    SettlingTimedOut: ("step",),
    PointMeasured: ("run", "step", "points"),
    HammerTestEnded: ("run",),
    HitJudged: ("run", "hits"),
    HitRevised: ("run", "hits"),
    DampingFound: ("damping",),
    CalibrationFound: ("calibration",),
    SentinelCompared: ("sentinels",),
    StruckFound: ("damping",),
    FitStarted: ("run", "fits"),
    FitFailed: ("run", "fits"),
    FitUpdated: ("fits",),
    DiagnosisStarted: ("run", "diagnosis"),
    DiagnosisFound: ("run", "diagnosis"),
    LimitWarned: ("limits",),
    StepsChosen: ("run",),
    StepDeclined: ("run", "step"),
    PlanOverruled: ("run",),
    FollowUpProposed: ("run", "diagnosis"),
    FollowUpDecided: ("run", "diagnosis"),
    FollowUpEnded: ("run",),
    LimitExceeded: ("limits",),
}


class SessionState:
    """What is known so far of one session.

    Attributes
    ----------
    contents : Contents
        Points with their times, hits with their records, segments, calibrations, sentinels, damping, the
        latest fit, the diagnosis. A hit whose samples were lost has an empty record.
    run : Run
        State, why it ended, what is waited for.
    step : Step or None
        The step in progress, or the last one: commands, samples, settling.
    fits : list of FitUpdated
        Every one, in order.
    fit_running : int or None
        Number of the fit being computed.
    fit_failed : FitFailed or None
        That the last one broke off, and why; until the next begins.
    limits : SweepSettings
        Tolerances and limits in force.
    """

    def __init__(self, configuration: Configuration, path: Path | None = None) -> None:
        self.configuration = configuration
        self._gather = Gather(Contents(path or Path(configuration.name), configuration), with_hits=True)
        self.contents = self._gather.contents
        self.limits: SweepSettings = sweep_settings(configuration.experiment, configuration.rig)
        self.run = Run(configuration.experiment)
        self.plan = Plan(configuration.experiment.sweep)
        self.step: Step | None = None
        self.readings = Readings()
        self.time_to_go = TimeToGo()
        self.acquisition: AcquisitionBegan | None = None
        self._latest = 0
        self.range: RangeSet | None = None
        self.signal_level: float | None = None
        self.fits: list[FitUpdated] = []
        self.fit_running: int | None = None
        self.fit_failed: FitFailed | None = None
        self.log, self._saying = Log(), Saying()
        self.changed: Counter[Topic] = Counter()
        self._clock = SessionClock()
        self._now_s = 0.0

    @property
    def time_s(self) -> float:
        """Since the session's first sample."""
        return self._now_s

    @property
    def version(self) -> int:
        """Grows with every change of anything."""
        return self.changed.total()

    def take(self, event: Event, at: float = 0.0) -> None:
        """One event of the stream, in order, and when it came on the clock of whoever watches it live."""
        self._clock.take(event)
        if isinstance(event, BlockAcquired):
            self._now_s = self._clock.at(event.first_sample + event.samples)
        elif isinstance(event, SoakBegan | TemperatureRead):
            self._now_s = max(self._now_s, self._clock.end_s)
        self._keep(event)
        self.run.take(event)
        self.plan.take(event)
        self.time_to_go.take(event, self._now_s, at)
        self._follow(event)
        self.readings.take(event, at)
        said = self._saying.line(event)
        if said is not None:
            self.say(said, "warning" if isinstance(event, LimitWarned) else "said")
        self._changed(*_TOPICS.get(type(event), ()))

    def say(self, text: str, kind: Kind = "said") -> None:
        """A line for the log, at this moment of the session."""
        self.log.add(self._now_s, text, kind)
        self._changed("log")

    def foresee(self, regions: tuple[Region, ...]) -> None:
        """What is going to be swept."""
        self.plan.foreseen = regions
        self._changed("run")

    def ask(self, question: str) -> None:
        """The run waits for a person; empty once it no longer does."""
        self.run.question = question
        self._changed("run")

    def begin(self) -> None:
        """A run is on its way; its stream says nothing yet."""
        self.run.state = "preparing"
        self.work("starting", None)

    def work(self, name: str, fraction: float | None) -> None:
        """Long work before or after measuring: how far it is; None where that is not known."""
        self.run.work = (name, fraction) if name else None
        if self.run.state == "diagnosing":
            self.time_to_go.computed(fraction)
        self._changed("run")

    def end(self, why: str, message: str) -> None:
        """The run is over, whether its stream said so or not."""
        said_already = self.run.over
        self.run.end(why, message)
        self.fit_running = None
        if not said_already:
            self.say(self.run.ending, "said" if why == "done" else "fault")
        self._changed("run", "fits")

    def peaks(self) -> tuple[float, float] | None:
        """Largest base acceleration and velocity of the newest block; None where there is none."""
        return self.readings.peaks(self._scaling(self.acquisition)) if self.acquisition is not None else None

    def _scaling(self, acquisition: AcquisitionBegan) -> Scaling:
        return Scaling.of(acquisition.channels, self.configuration.rig.channels.named())

    def _keep(self, event: Event) -> None:
        try:
            self._gather.take(event)
        except BadInput as missing:
            assert isinstance(event, HitJudged)
            rate = self.acquisition.sample_rate_hz if self.acquisition is not None else 1.0
            self._gather.hits.append(_without_samples(event, rate))
            self.say(str(missing), "warning")

    def _follow(self, event: Event) -> None:
        """What only a person watching needs."""
        match event:
            case SessionBegan() if self.log.began is None:
                self.log.began = datetime.fromisoformat(event.utc)
            case AcquisitionBegan():
                self.acquisition, self.step, self._latest = event, None, 0
            case BlockAcquired():
                self._latest = event.first_sample + event.samples
            case RangeSet():
                self.range = event
            case SignalLevelRead():
                self.signal_level = event.value
            case StepBegan() if self.acquisition is not None:
                scaling = self._scaling(self.acquisition)
                self.step = Step(event, self.acquisition, scaling, self._latest)
            case FitStarted():
                self.fit_running, self.fit_failed = event.number, None
            case FitFailed():
                self.fit_running, self.fit_failed = None, event
            case FitUpdated():
                self.fits.append(event)
                self.fit_running = None
            case SessionEnded():
                self.fit_running = None
                self.say(self.run.ending, "said" if event.why == "done" else "fault")
        if self.step is not None:
            self.step.take(event, self.range)

    def _changed(self, *topics: Topic) -> None:
        self.changed.update(topics)


def _without_samples(hit: HitJudged, sample_rate_hz: float) -> RecordedHit:
    none = np.zeros(0)
    record = Hit(f"hit {hit.hit}", sample_rate_hz, none, (ResponseChannel("response", "acceleration", none),))
    return RecordedHit(hit.hit, hit.accepted, hit.why, hit.peak_n, record)
