"""One run of a session: what needs the rig, recorded and analysed as it happens, then the diagnosis."""

import threading
from contextlib import ExitStack
from dataclasses import dataclass
from datetime import UTC, datetime

from drivers.errors import DriverError
from drivers.shaker import Alarm
from fitting.errors import TooFewPoints
from fitting.identification.bare_plate import match_modes
from fitting.specimen import PlateSpecimen
from instrument.check.forecast import Forecast, distinct
from instrument.errors import NOT_SILENT, RigStopped, ShakerNotSilent, fault_words
from instrument.files.hammer_file import accepted_modes
from instrument.hammer_test.struck import FEWEST_HITS
from instrument.progress import Progress, quiet
from instrument.run.analysis import Analysis
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.run.following import Earlier, Following
from instrument.run.live_diagnosis import Diagnoser, ToDiagnose, able, apart
from instrument.run.live_fit import Fitter
from instrument.run.part import Part
from instrument.run.rig import Rig, open_rig
from instrument.run.runner import Runner
from instrument.run.soaking import ask_set_point
from instrument.run.striking import Striking
from instrument.run.sweep_part import SweepPart
from instrument.session.configuration import Experiment
from instrument.session.journal import SessionJournal
from instrument.session.recorder import Recorder
from instrument.session.setup import setup_of
from instrument.simulated_case.spot import spot_elsewhere
from instrument.stream.derived import DampingFound, DiagnosisFound, FitUpdated
from instrument.stream.event import Derived, Event
from instrument.stream.raw import (
    DiagnosisStarted,
    Ending,
    FollowUpDecided,
    FollowUpProposed,
    SessionBegan,
    SessionEnded,
)

_MODES_TO_TELL = 3
"""Fewer modes do not tell one plate from another."""

_FOLLOWING = (DiagnosisFound, FollowUpProposed, FollowUpDecided)


@dataclass(frozen=True)
class RunRequest:
    """What a run is asked to do, and who steers it, computes for it and is told of it."""

    experiment: Experiment
    parts: tuple[Part, ...]
    control: RunControl
    fit: Fitter
    diagnose: Diagnoser
    companion: Companion
    progress: Progress


class SessionRun:
    """Measures and analyses one session, new or carried on, and records it."""

    def __init__(
        self, request: RunRequest, journal: SessionJournal, forecast: Forecast, earlier: list[Event]
    ) -> None:
        """`earlier` are the events of a run that was broken off."""
        self._request, self._experiment, self._in_order = request, request.experiment, threading.Lock()
        self._resumed = bool(earlier)
        self._configuration = journal.configuration()
        self._setup = setup_of(self._configuration)
        self.analysis = Analysis(self._setup)
        for event in earlier:
            self.analysis.restore(event)
        self._sweep = (
            SweepPart(
                self._experiment,
                specimen=self._configuration.the_specimen(),
                setup=self._setup,
                forecast=forecast,
                analysis=self.analysis,
                earlier=earlier,
                record=self._record,
                fit=request.fit,
            )
            if "sweep" in request.parts and self._experiment.document.sweep is not None
            else None
        )
        self._earlier = Earlier.of(earlier)
        self.following: list[Event] = [e for e in earlier if isinstance(e, _FOLLOWING)]
        self._diagnoses = sum(isinstance(e, DiagnosisStarted) for e in earlier)
        self.diagnosis: DiagnosisFound | None = None

    @property
    def fit(self) -> FitUpdated | None:
        """The last fit of all points; None before there is one."""
        return self._sweep.fit if self._sweep is not None else None

    @property
    def lacks_fits_alone(self) -> bool:
        """Whether the sweep is measured: what is left needs no rig."""
        return self._sweep is not None and self._sweep.is_measured

    def run(self, recorder: Recorder) -> None:
        """Everything that needs the rig; the recorder hears of its end whatever it is."""
        self._recorder = recorder
        try:
            self._prepare()
            document = self._experiment.document
            spot_m = spot_elsewhere(self._experiment.the_specimen())
            with ExitStack() as stack:
                # What a simulated rig builds first it shows itself.
                shown = quiet if self._experiment.rig.is_simulated else self._request.progress
                with shown("connecting to the instruments"):
                    bare = stack.enter_context(
                        open_rig(
                            self._experiment.rig,
                            self._experiment.rig_path,
                            document.hammer,
                            spot_m,
                        )
                    )
                rig = stack.enter_context(self._request.companion.with_rig(bare))
                try:
                    self._go(rig)
                except BaseException as error:
                    # Letting go of the rig may take long, and whoever goes along with it asks why.
                    self._request.control.ends(error)
                    raise
            if not self._follows:
                # The rig is let go of first: nothing of it is needed any more.
                self.diagnosis = self._diagnose()
        except (Exception, KeyboardInterrupt) as error:
            first = self._request.control.ends(error)
            self._end(*_ending(first))
            if first is not error:
                raise first from None
            raise
        self._request.control.measured()
        self._end("done", "")

    def _prepare(self) -> None:
        if self._sweep is not None and self._sweep.table.plan == "adaptive":
            self._request.control.chooses_steps = True
            with self._request.progress("models of the adaptive sweep"):
                self._sweep.prepare()

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
        if self._sweep is not None:
            ask_set_point(rig, self._experiment.document.temperature)
        choice = self._sweep.choice if self._sweep else None
        runner = Runner(rig, self.analysis, self._emit, self._request.control, self._setup.sweep, choice)
        if "hammer" in self._request.parts and self.analysis.damping is None:
            self._hammer(rig, runner)
            if self._sweep is not None and self.analysis.damping is not None:
                self._question_plate(self.analysis.damping)
        if self._sweep is not None:
            self._sweep.run(rig, runner, self._emit)
            if self._follows:
                self._follow(self._sweep, rig, runner)

    def _hammer(self, rig: Rig, runner: Runner) -> None:
        settings, hammer = self._setup.hammer, self._experiment.document.hammer
        if settings is None or hammer is None:
            return
        self._emit(rig.operator.mount("bare"))
        Striking(runner, rig, self.analysis, self._emit).bare(settings.hits, hammer.wait_s)
        if self.analysis.damping is None:
            raise RigStopped(_without_a_hit(self.analysis, hammer.wait_s))

    def _blows(self, rig: Rig, runner: Runner) -> None:
        """On the treated plate, as it is held now."""
        settings, hammer, before = self._setup.hammer, self._experiment.document.hammer, self.analysis.struck
        assert settings is not None
        assert hammer is not None
        names = [r.name for r in distinct(rig.vibrometer.ranges)]
        calibrated = [k for k, name in enumerate(names) if name in self.analysis.calibrations]
        ranges = names[max(calibrated, default=-1) :]
        wanted = max(FEWEST_HITS, settings.hits)
        Striking(runner, rig, self.analysis, self._emit).treated(wanted, hammer.wait_s, ranges)
        if self.analysis.struck is before:
            raise RigStopped(_without_a_hit(self.analysis, hammer.wait_s))

    def _question_plate(self, found: DampingFound) -> None:
        """Stop before a sweep of what is not the stated plate; a run carried on is not asked again."""
        modes = accepted_modes(found.result)
        if modes is None or len(modes.frequency_hz) < _MODES_TO_TELL:
            return
        plate = self._configuration.the_specimen()
        if not isinstance(plate, PlateSpecimen):
            return
        try:
            match_modes(plate, *modes)
        except TooFewPoints as error:
            raise RigStopped(
                f"stopped before the sweep: {error} Right the specimen's file or mount the right plate and "
                "begin again; or carry on as it is with --resume"
            ) from None

    @property
    def _follows(self) -> bool:
        """Whether more may be measured once a diagnosis is there."""
        return self._sweep is not None and self._experiment.document.diagnosis.follow_up != "none"

    def _follow(self, sweep: SweepPart, rig: Rig, runner: Runner) -> None:
        def ready() -> None:
            # Nobody has beaten the heartbeat while the computer was at work, or a person.
            _clear_heartbeat_alarm(rig)

        strikes = self._setup.hammer is not None
        following = Following(
            self._experiment.document.diagnosis,
            self._setup.sweep.limits,
            self._configuration.the_specimen(),
            self.analysis,
            sweep,
            self._earlier,
            self._emit,
            self._diagnose,
            (lambda: self._hammer(rig, runner)) if strikes else None,
            (lambda: self._blows(rig, runner)) if strikes else None,
            self._experiment.document.whole_length_m,
        )
        following.run(rig, runner, ready)
        self.diagnosis = following.found

    def _diagnose(self) -> DiagnosisFound | None:
        """What the fit of all points cannot explain; where there is no law there is nothing to ask."""
        if self.fit is None or self.fit.message:
            return None
        self._diagnoses += 1
        number, last = self._diagnoses, self.fit.last_step
        started = DiagnosisStarted(number, last)
        self._record(started)
        specimen = self._configuration.the_specimen()
        possible = able(self._experiment.document, self._setup.sweep, number, self.analysis.followed)
        asked = ToDiagnose.of(self.analysis, started, specimen, possible)
        found = apart(lambda: self._request.diagnose(asked))
        self._record(found)
        return found

    def _emit(self, event: Event) -> list[Derived]:
        """Into the stream: recorded, analysed, what follows recorded too."""
        self._record(event)
        derived = self.analysis.feed(event)
        for one in derived:
            self._record(one)
        if self._sweep is not None:
            self._sweep.happened(event)
        return derived

    def _record(self, event: Event) -> None:
        """Onto the disk, and told; the fit's thread does so too, and the order is the same for both."""
        with self._in_order:
            self._recorder.record(event)
            self._request.companion.happened(event)
        if isinstance(event, _FOLLOWING):
            self.following.append(event)

    def _end(self, why: Ending, message: str) -> None:
        try:
            self._record(SessionEnded(why, message))
        except RigStopped:
            # The recorder itself is what failed; its own message is on the way already.
            return


def _ending(error: BaseException) -> tuple[Ending, str]:
    """How a run ended that ended by this, and its message."""
    match error:
        case ShakerNotSilent():
            return NOT_SILENT, " ".join(str(error).split())
        case RigStopped() | DriverError():
            return "stopped safely", " ".join(str(error).split())
        case KeyboardInterrupt():
            return "stopped by the user", ""
        case MemoryError():
            return "stopped safely", fault_words(error)
    return "stopped safely", f"internal error, {type(error).__name__}"


def _without_a_hit(analysis: Analysis, wait_s: float) -> str:
    refused = analysis.hammer.rejected_in_a_row if analysis.hammer is not None else []
    if not refused:
        return f"no good hit within {wait_s:g} s: is the hammer's channel connected?"
    return f"no good hit of {len(refused)}: the last was refused: {refused[-1]}"


def _clear_heartbeat_alarm(rig: Rig) -> None:
    """A heartbeat that stopped with an earlier program is back. Other alarms are a person's matter."""
    if rig.shaker.status().alarm == Alarm.HEARTBEAT:
        rig.shaker.beat()
        rig.shaker.reset_alarm()
