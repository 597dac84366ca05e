"""A whole experiment: hammer test, calibration, sweep, live identification, diagnosis, one session."""

import logging
import re
import threading
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal

from threadpoolctl import threadpool_limits

from drivers.errors import DriverError
from drivers.shaker import Alarm
from fitting.errors import TooFewPoints
from fitting.identification.bare_plate import match_modes
from instrument.check.faults import experiment_objections
from instrument.check.forecast import (
    Forecast,
    calibration_segments,
    distinct,
    planned_segments,
    with_next_coarser,
)
from instrument.check.work import planned_work
from instrument.errors import BadInput, RigStopped, StoppedByUser
from instrument.files.hammer_file import accepted_modes
from instrument.progress import Progress, quiet
from instrument.run.analysis import Analysis
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.run.live_choice import Chooser, LiveChoice
from instrument.run.live_diagnosis import Diagnoser, apart, diagnose_points
from instrument.run.live_fit import Fitter, LiveFit, fit_points
from instrument.run.rig import Rig, open_rig
from instrument.run.runner import Runner
from instrument.session.configuration import Configuration, Experiment
from instrument.session.journal import SessionJournal
from instrument.session.recorder import Recorder
from instrument.session.setup import setup_of
from instrument.session.storage import part_events, write_session
from instrument.stepped_sine.adaptive import AdaptivePlanner
from instrument.stepped_sine.plan import Done, PlannedSegment
from instrument.stream.derived import (
    DampingFound,
    DiagnosisFound,
    FitUpdated,
    HitJudged,
    PointMeasured,
    StepsChosen,
)
from instrument.stream.event import Derived, Event
from instrument.stream.raw import (
    BlockAcquired,
    ChoiceStarted,
    DiagnosisStarted,
    SegmentEnded,
    SessionBegan,
    SessionEnded,
)

log = logging.getLogger(__name__)

_MODES_TO_TELL = 3
"""Fewer modes do not tell one plate from another."""

Part = Literal["hammer", "sweep"]
Watch = Callable[[list[Event]], None]
"""Told of events once they are on the disk, on the recorder's thread."""


@dataclass(frozen=True)
class Finished:
    """What a run left."""

    session: Path
    damping: DampingFound | None
    fit: FitUpdated | None
    points: tuple[PointMeasured, ...]
    diagnosis: DiagnosisFound | None = None
    """None where the sweep was not run, or no law could be identified from it."""


def run_experiment(
    experiment: Experiment,
    out: Path,
    parts: tuple[Part, ...],
    *,
    control: RunControl | None = None,
    watch: Watch | None = None,
    resume: Path | None = None,
    progress: Progress = quiet,
    fit: Fitter = fit_points,
    diagnose: Diagnoser = diagnose_points,
    companion: Companion | None = None,
) -> Finished:
    """Run the parts and leave a session file in `out`. Raises `BadInput`, `RigStopped`, `StoppedByUser`.

    Whatever ends the run, the shaker is silent and what is complete is kept; the message says where.
    """
    # One thread for all sums: with several, their last bit would depend on what else runs.
    with threadpool_limits(1, "blas"):
        return _run(
            experiment,
            out,
            parts,
            control or RunControl(),
            watch,
            resume,
            progress,
            fit,
            diagnose,
            companion or Companion(),
        )


def _run(
    experiment: Experiment,
    out: Path,
    parts: tuple[Part, ...],
    control: RunControl,
    watch: Watch | None,
    resume: Path | None,
    progress: Progress,
    fit: Fitter,
    diagnose: Diagnoser,
    companion: Companion,
) -> Finished:
    with progress("forecasting the sweep"):
        forecast = Forecast.of(experiment.the_specimen())
        objections = experiment_objections(experiment, forecast, parts)
    if objections:
        more = f" (and {len(objections) - 1} more: viscorig check lists them)" if len(objections) > 1 else ""
        raise BadInput(objections[0] + more)
    journal, name = _journal(experiment, out, resume)
    entries = journal.entries()
    earlier = [event for e in entries for event in part_events(journal.folder / e.file)]
    path = journal.folder.parent / f"{name}.h5"
    companion.recording(journal.folder, path)
    companion.planned(planned_work(experiment, forecast, parts))
    for event in earlier:
        if not isinstance(event, BlockAcquired):
            companion.happened(event)
    session = _Session(
        experiment, journal, forecast, control, earlier, parts, fit, diagnose, companion, progress
    )
    try:
        with Recorder(journal, entries, watch) as recorder:
            session.run(recorder)
        recorder.check()
        finish_session(journal, path)
    except (RigStopped, DriverError, OSError) as error:
        raise RigStopped(f"{' '.join(str(error).split())}; {_kept(journal, path)}") from error
    except KeyboardInterrupt:
        raise StoppedByUser(_kept(journal, path)) from None
    except BadInput as error:
        raise BadInput(f"{error}; {_kept(journal, path)}") from error
    except Exception as error:  # a fault of this program: what was measured is kept all the same
        log.debug("internal error", exc_info=True)
        said = f"internal error, {type(error).__name__}: {' '.join(str(error).split())}"
        raise RigStopped(f"{said}; {_kept(journal, path)}") from error
    finally:
        journal.unlock()
    points = tuple(session.analysis.points)
    return Finished(path, session.analysis.damping, session.fit, points, session.diagnosis)


def finish_session(journal: SessionJournal, path: Path) -> int:
    """Put a session file together from what is sealed and remove the folder; how many parts there were.

    Raises `BadInput` where nothing is sealed.
    """
    entries = journal.entries()
    if not entries:
        raise BadInput(f"{journal.folder}: nothing was completed, there is no session to put together")
    write_session(path, journal.configuration(), [journal.folder / e.file for e in entries])
    journal.remove()
    return len(entries)


class _Session:
    def __init__(
        self,
        experiment: Experiment,
        journal: SessionJournal,
        forecast: Forecast,
        control: RunControl,
        earlier: list[Event],
        parts: tuple[Part, ...],
        fit: Fitter,
        diagnose: Diagnoser,
        companion: Companion,
        progress: Progress,
    ) -> None:
        self._progress = progress
        self._fitter, self._diagnoser = fit, diagnose
        self._companion, self._in_order = companion, threading.Lock()
        self._experiment, self._forecast, self._control = experiment, forecast, control
        self._parts, self._resumed = parts, bool(earlier)
        self._configuration = journal.configuration()
        self._setup = setup_of(self._configuration)
        self.analysis = Analysis(self._setup)
        for event in earlier:
            self.analysis.restore(event)
        self._earlier_choices = [e for e in earlier if isinstance(e, StepsChosen)]
        self._chooser: Chooser | None = None
        self._choosing: LiveChoice | None = None
        self._last_step = max((getattr(e, "step", 0) for e in earlier), default=0)
        self._calibration_points = tuple(
            e for e in earlier if isinstance(e, PointMeasured) and e.purpose == "calibration"
        )
        self._diagnoses = sum(isinstance(e, DiagnosisStarted) for e in earlier)
        self.fit: FitUpdated | None = None
        self.diagnosis: DiagnosisFound | None = None

    def run(self, recorder: Recorder) -> None:
        """Everything that needs the rig; the recorder hears of its end whatever it is."""
        self._recorder = recorder
        try:
            self._prepare()
            document = self._experiment.document
            with (
                open_rig(self._experiment.rig, self._experiment.rig_path, document.hammer) as bare,
                self._companion.with_rig(bare) as rig,
            ):
                self._go(rig)
            # The rig is let go of first: nothing of it is needed any more.
            self._diagnose()
        except (RigStopped, DriverError) as error:
            self._end("stopped safely", " ".join(str(error).split()))
            raise
        except KeyboardInterrupt:
            self._end("stopped by the user", "")
            raise
        except Exception as error:
            self._end("stopped safely", f"internal error, {type(error).__name__}")
            raise
        self._end("done", "")

    def _prepare(self) -> None:
        """Models that choices are made with, before anything moves; a hammer test changes little of them."""
        table = self._experiment.document.sweep
        if "sweep" not in self._parts or table is None or table.plan != "adaptive":
            return
        with self._progress("models of the adaptive sweep"):
            specimen = self._configuration.the_specimen()
            self._chooser = Chooser(specimen, table, self._setup.sweep, self._earlier_choices)
            self._chooser.ground(self.analysis.damping)

    def _go(self, rig: Rig) -> None:
        self._emit(
            SessionBegan(
                datetime.now(UTC).isoformat(timespec="seconds"),
                self._configuration.versions["viscorig"],
                rig.identities(),
                tuple(r.name for r in distinct(rig.vibrometer.ranges)),
                self._resumed,
            )
        )
        _clear_heartbeat_alarm(rig)
        ramp_s = self._setup.sweep.control.ramp_s
        runner = Runner(rig, self.analysis, self._emit, self._control, ramp_s, self._choice)
        if "hammer" in self._parts and self.analysis.damping is None:
            self._hammer(rig, runner)
        if "sweep" in self._parts:
            self._sweep(rig, runner)

    def _hammer(self, rig: Rig, runner: Runner) -> None:
        settings, hammer = self._setup.hammer, self._experiment.document.hammer
        if settings is None or hammer is None:
            return
        self._emit(rig.operator.mount("bare"))
        runner.hammer(settings.hits, hammer.wait_s)
        if self.analysis.damping is None:
            raise RigStopped(f"no good hit within {hammer.wait_s:g} s: is the hammer's channel connected?")
        if "sweep" in self._parts:
            self._question_plate(self.analysis.damping)

    def _question_plate(self, found: DampingFound) -> None:
        """Stop before a sweep of what is not the stated plate; a run carried on is not asked again."""
        modes = accepted_modes(found.result)
        if modes is None or len(modes.frequency_hz) < _MODES_TO_TELL:
            return
        try:
            match_modes(self._configuration.the_specimen(), *modes)
        except TooFewPoints as error:
            raise RigStopped(
                f"stopped before the sweep: {error} Right the specimen's file or mount the right plate and "
                "begin again; or carry on as it is with --resume"
            ) from None

    def _sweep(self, rig: Rig, runner: Runner) -> None:
        table = self._experiment.document.sweep
        if table is None:
            return
        self._emit(rig.operator.mount("damped"))
        settings, ranges = self._setup.sweep, distinct(rig.vibrometer.ranges)
        segments, sentinel = planned_segments(self._forecast, table, ranges)
        used = [s.range_name for s in segments] + ([sentinel[1]] if sentinel else [])
        names = [n for n in with_next_coarser(used, ranges) if n not in self.analysis.calibrations]
        done = Done((*self.analysis.points, *self._calibration_points))
        planner = AdaptivePlanner(settings, self._forecast.decay_1_s, sentinel, self._last_step + 1, done)
        calibration = calibration_segments(table, names, ranges)
        if calibration:
            self._emit(rig.operator.aim("base"))
            runner.sweep("calibration", planner.plan(calibration))
        self._emit(rig.operator.aim("pickup"))
        if self._experiment.document.temperature is not None:
            runner.soak(self._experiment.document.temperature)
        self._live = LiveFit(self._configuration.the_specimen(), self._record, self._fitter)
        with self._live:
            if table.plan == "adaptive":
                self._adaptive(runner, planner, segments[0])
            else:
                runner.sweep("sweep", planner.plan(segments))
            self._live.offer(self.analysis.points, self.analysis.damping)
        self.fit = self._live.latest

    def _adaptive(self, runner: Runner, planner: AdaptivePlanner, band: PlannedSegment) -> None:
        """A sweep that chooses its own steps; all in the range that has room for the band's resonances."""
        chooser = self._chooser
        assert chooser is not None
        chooser.ground(self.analysis.damping)
        planner.level_m_s2, planner.chosen = band.level_m_s2[0], dict(chooser.chosen)
        planner.range_of = lambda frequency_hz: band.range_name
        with LiveChoice(chooser, self._record) as self._choosing:
            runner.sweep("sweep", planner.adaptive())

    def _choice(self, number: int, patience_s: float) -> StepsChosen | None:
        assert self._choosing is not None
        return self._choosing.take(number, patience_s)

    def _diagnose(self) -> None:
        """What the whole sweep's fit cannot explain; where there is no law there is nothing to ask."""
        if self.fit is None or self.fit.message:
            return
        a, number, last = self.analysis, self._diagnoses + 1, self.fit.last_step
        self._record(DiagnosisStarted(number, last))
        specimen = self._configuration.the_specimen()
        self.diagnosis = apart(
            lambda: self._diagnoser(number, last, a.points, a.times_s, a.damping, specimen)
        )
        self._record(self.diagnosis)

    def _emit(self, event: Event) -> list[Derived]:
        """Into the stream: recorded, analysed, what follows recorded too."""
        self._record(event)
        derived = self.analysis.feed(event)
        for one in derived:
            self._record(one)
        if isinstance(event, SegmentEnded) and self.analysis.points and event.sweep > 0:
            self._live.offer(self.analysis.points, self.analysis.damping)
        if isinstance(event, ChoiceStarted) and self._choosing is not None:
            self._choosing.start(event, self.analysis.points, self.analysis.damping)
        return derived

    def _record(self, event: Event) -> None:
        """Onto the disk, and told; the fit's thread does so too, and the order is the same for both."""
        with self._in_order:
            self._recorder.record(event)
            self._companion.happened(event)

    def _end(self, why: Literal["done", "stopped by the user", "stopped safely"], message: str) -> None:
        try:
            self._record(SessionEnded(why, message))
        except RigStopped:
            # The recorder itself is what failed; its own message is on the way already.
            return


def _clear_heartbeat_alarm(rig: Rig) -> None:
    """A heartbeat that stopped with an earlier program is back. Other alarms are a person's matter."""
    if rig.shaker.status().alarm == Alarm.HEARTBEAT:
        rig.shaker.beat()
        rig.shaker.reset_alarm()


def _journal(experiment: Experiment, out: Path, resume: Path | None) -> tuple[SessionJournal, str]:
    now = datetime.now(UTC)
    if resume is not None:
        journal = SessionJournal(resume)
        name = resume.name.removesuffix(".running")
        before = journal.configuration()
        _refuse_another(before, experiment.configuration(before.name, before.created_utc))
        journal.lock()
        journal.truncate(journal.entries())
        return journal, name
    stem = re.sub(r"[^A-Za-z0-9_-]+", "-", experiment.path.stem).strip("-") or "session"
    name = f"{stem}-{now:%Y%m%dT%H%M%SZ}"
    journal = SessionJournal(out / f"{name}.running")
    journal.begin(experiment.configuration(name, now.isoformat(timespec="seconds")))
    journal.lock()
    return journal, name


def _refuse_another(before: Configuration, now: Configuration) -> None:
    """A session is of one experiment; only where the instruments answer may differ."""
    for part in ("experiment", "specimen", "rig"):
        then, given = (getattr(c, part) for c in (before, now))
        if part == "rig":
            then, given = (r.anywhere() for r in (then, given))
        if then != given:
            raise BadInput(
                f"{before.name}: the {part} file is not the one this run was begun with: "
                "resume with it as it was, or begin a new run"
            )


def _kept(journal: SessionJournal, path: Path) -> str:
    """Put together what is complete; where it is. A run without anything complete leaves nothing."""
    try:
        entries = journal.entries()
        events = [e for entry in entries for e in part_events(journal.folder / entry.file)]
        if not any(isinstance(e, PointMeasured | HitJudged) for e in events):
            journal.remove()
            return "nothing was measured"
        write_session(path, journal.configuration(), [journal.folder / e.file for e in entries])
        steps = sum(len(e.steps) for e in entries)
        hits = sum(isinstance(e, HitJudged) for e in events)
        done = " and ".join(f"{n} {what}" for n, what in ((hits, "hits"), (steps, "steps")) if n)
        return f"{done} kept in {path}; to go on: --resume {journal.folder}"
    except (OSError, ValueError, RuntimeError):
        return f"what is complete is in {journal.folder}: viscorig recover {journal.folder}"
