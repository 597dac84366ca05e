"""A recorded session through the same analysis again: derived events computed anew and compared."""

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import islice
from time import monotonic, sleep

from threadpoolctl import threadpool_limits

from fitting.specimen import PlateSpecimen
from instrument.run.analysis import Analysis
from instrument.run.differences import as_known_then, first_difference, said_otherwise
from instrument.run.live_choice import Chooser
from instrument.run.live_diagnosis import Diagnoser, ToDiagnose, able, diagnose_points
from instrument.run.live_fit import Fitter, fit_points
from instrument.session.setup import setup_of
from instrument.session.storage import SessionFile
from instrument.stream.derived import (
    DiagnosisFound,
    FitUpdated,
    PointMeasured,
    StepsChosen,
    StepSettled,
)
from instrument.stream.event import Derived, Event, from_line, to_line
from instrument.stream.raw import (
    AcquisitionBegan,
    BlockAcquired,
    ChoiceStarted,
    DiagnosisStarted,
    FitFailed,
    FitStarted,
    SessionBegan,
    SessionEnded,
)

Watch = Callable[[Event], None]
_MOST_DIFFERENCES = 20


@dataclass
class Replayed:
    """What the recording gave this time."""

    points: list[PointMeasured] = field(default_factory=list)
    fit: FitUpdated | None = None
    diagnosis: DiagnosisFound | None = None
    derived: int = 0
    """Events computed again."""
    differences: list[str] = field(default_factory=list)
    """Where they differ from the recorded ones; the first few."""
    words: list[str] = field(default_factory=list)
    """Where they are the recorded ones in other words: sentences of another version; the first few."""

    @property
    def equal(self) -> bool:
        """Every derived event as it was recorded, numbers to the bit and verdicts, whatever the words."""
        return not self.differences


def replay(
    session: SessionFile,
    *,
    speed: float | None = None,
    watch: Watch = lambda event: None,
    fit: Fitter = fit_points,
    diagnose: Diagnoser = diagnose_points,
) -> Replayed:
    """Run a session again. `speed` 1 is as it was; None as fast as it goes."""
    with threadpool_limits(1, "blas"):
        return _replay(session, _ReplayPace(speed), watch, fit, diagnose)


def _replay(
    session: SessionFile, pace: "_ReplayPace", watch: Watch, fit: Fitter, diagnose: Diagnoser
) -> Replayed:
    configuration = session.configuration
    specimen = configuration.the_specimen()
    setup, table = setup_of(configuration), configuration.experiment.sweep
    settled_at, failed = _settled_at(session), _failed(session)
    analysis = Analysis(setup, settled_at)
    adaptive = table is not None and table.plan == "adaptive"
    chooser = None
    if adaptive and table is not None and isinstance(specimen, PlateSpecimen):
        chooser = Chooser(specimen, table, setup.sweep, [])
    again = Replayed()
    expected: list[Derived] = []
    apart: dict[tuple[type[Derived], int], Derived] = {}
    ended = False
    for before, event in enumerate(session.events()):
        pace.wait(event)
        if isinstance(event, FitUpdated | DiagnosisFound | StepsChosen):
            # Recorded whenever its thread was done: paired with its computation by number.
            _compare(again, apart.pop((type(event), event.number), None), event)
            continue
        if isinstance(event, Derived):
            _compare(again, expected.pop(0) if expected else None, event)
            continue
        if isinstance(event, SessionBegan):
            # The run is carried on with what is recorded: a broken-off step ends here, and what was found by
            # then and did not get onto the disk is found again.
            expected, analysis = [], Analysis(setup, settled_at)
            for earlier in islice(session.events(with_samples=False), before):
                analysis.restore(earlier)
        watch(event)
        derived = analysis.feed(event)
        expected += derived
        if isinstance(event, FitStarted) and before not in failed:
            again.fit = fit(event.number, event.last_step, analysis.points, analysis.damping, specimen)
            apart[FitUpdated, event.number] = again.fit
            derived = [*derived, again.fit]
        elif isinstance(event, ChoiceStarted) and chooser is not None:
            chosen = chooser.choose(event, analysis.points, analysis.damping)
            apart[StepsChosen, event.number] = chosen
            derived = [*derived, chosen]
        elif isinstance(event, DiagnosisStarted):
            possible = able(configuration.experiment, setup.sweep, event.number, analysis.followed)
            again.diagnosis = diagnose(ToDiagnose.of(analysis, event, specimen, possible))
            apart[DiagnosisFound, event.number] = again.diagnosis
            derived = [*derived, again.diagnosis]
        for one in derived:
            watch(one)
        ended = isinstance(event, SessionEnded) and event.why == "done"
    if ended and expected:
        again.differences.append(f"computed but not recorded: {to_line(expected[0])[:200]}")
    again.points = list(analysis.points)
    return again


def _settled_at(session: SessionFile) -> dict[int, frozenset[int]]:
    """Of every step that settled, where it did: what was recorded behind that is its reading."""
    found: dict[int, frozenset[int]] = {}
    for event in session.events(with_samples=False):
        if isinstance(event, StepSettled):
            found[event.step] = found.get(event.step, frozenset()) | {event.sample}
    return found


def _failed(session: SessionFile) -> set[int]:
    """Of the session's events, which are the `FitStarted` of fits that failed: none is computed again.

    By their place: a run that is carried on counts its fits anew.
    """
    found: set[int] = set()
    # One fit at a time: what ended is the last that had started, and only once.
    running: tuple[int, int] | None = None
    for place, event in enumerate(session.events(with_samples=False)):
        match event:
            case FitStarted():
                running = event.number, place
            case FitUpdated() | SessionBegan():
                running = None
            case FitFailed() if running is not None and running[0] == event.number:
                found.add(running[1])
                running = None
    return found


def _compare(again: Replayed, computed: Derived | None, recorded: Derived) -> None:
    again.derived += 1
    if len(again.differences) >= _MOST_DIFFERENCES:
        return
    if computed is None:
        again.differences.append(f"recorded but not computed again: {to_line(recorded)[:200]}")
        return
    # Both as a session gives them: 9 in a field of floats is 9.0 there.
    as_read = as_known_then(from_line(to_line(computed)), recorded)
    if to_line(as_read) == to_line(recorded):
        return
    if not said_otherwise(as_read, recorded):
        again.differences.append(first_difference(as_read, recorded))
    elif len(again.words) < _MOST_DIFFERENCES:
        again.words.append(first_difference(as_read, recorded))


class _ReplayPace:
    """Holds a replay back to a speed, by the sample counter."""

    def __init__(self, speed: float | None) -> None:
        self._speed = speed
        self._rate = 1.0
        self._began = monotonic()

    def wait(self, event: Event) -> None:
        if self._speed is None:
            return
        if isinstance(event, AcquisitionBegan):
            self._rate, self._began = event.sample_rate_hz, monotonic()
        elif isinstance(event, BlockAcquired):
            due = self._began + (event.first_sample + event.samples) / self._rate / self._speed
            sleep(max(0.0, due - monotonic()))
