"""The diagnosis of a sweep that is whole: apart from the run's own thread, its result an event."""

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from pydantic import ValidationError
from threadpoolctl import threadpool_limits

from fitting.errors import FittingError
from fitting.structures import AnySpecimen
from instrument.errors import BadInput
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.follow_up import FollowUp
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.hammer_file import accepted_modes
from instrument.finding.diagnosis import diagnose
from instrument.interchange.files_of import files_of
from instrument.planning.follow_up import Possible
from instrument.planning.open_questions import with_open_questions
from instrument.processes.other_processes import end_all
from instrument.progress import Progress, quiet
from instrument.results.diagnosis_from import diagnosis_from
from instrument.run.analysis import Analysis
from instrument.session.points import sweep_of, uncalibrated
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import DampingFound, DiagnosisFound, PointMeasured, StruckFound
from instrument.stream.raw import DiagnosisStarted


@dataclass(frozen=True)
class ToDiagnose:
    """What a diagnosis within a run is made of."""

    number: int
    """Of the run's diagnoses, from 1."""
    last_step: int
    """Points of later steps are left out."""
    points: Sequence[PointMeasured]
    times_s: Sequence[float]
    """When each point was read."""
    damping: DampingFound | None
    """The hammer test of the bare plate."""
    struck: tuple[StruckFound, ...]
    """Hammer tests of the treated plate."""
    specimen: AnySpecimen
    possible: Possible
    """What may be measured next."""

    @classmethod
    def of(
        cls, analysis: Analysis, started: DiagnosisStarted, specimen: AnySpecimen, possible: Possible
    ) -> "ToDiagnose":
        """Everything that an analysis has by now, for the diagnosis that was started."""
        a = analysis
        given = (a.points, a.times_s, a.damping, tuple(a.struck), specimen, possible)
        return cls(started.number, started.last_step, *given)


Diagnoser = Callable[[ToDiagnose], DiagnosisFound]


def able(
    document: ExperimentDocument, settings: SweepSettings, number: int, done: Sequence[FollowUp] = ()
) -> Possible:
    """What may follow the diagnosis of a number, of a run that steps so: as much as it still allows.

    Once it allows nothing more a person may measure as after any diagnosis; what is `done` is not advised
    once more.
    """
    table, whole, made = document.diagnosis, document.whole_length_m, tuple(done)
    left = table.follow_up_at_most + 1 - number
    if table.follow_up == "none" or left < 1:
        return Possible(settings, whole_length_m=whole, done=made)
    most_s = table.follow_up_most_s
    return Possible(settings, measurements=left, most_s=most_s, whole_length_m=whole, done=made)


def diagnose_points(asked: ToDiagnose, progress: Progress = quiet) -> DiagnosisFound:
    """Diagnose all points up to a step, jointly with all that was struck. Pure: the same in a replay.

    What is proposed next is possible: within the run's limits, at what its steps take.
    """
    number, last_step = asked.number, asked.last_step
    used = [(p, t) for p, t in zip(asked.points, asked.times_s, strict=True) if p.step <= last_step]
    asked = replace(asked, points=[p for p, _ in used], times_s=[t for _, t in used])
    try:
        # One thread: sums in another order would differ in the last bit.
        with threadpool_limits(1):
            return DiagnosisFound(number, last_step, _result(asked, progress))
    except (FittingError, BadInput, ValidationError, ValueError, ArithmeticError) as error:
        # Data may be such that nothing can be said of them: that is said, and the session is kept.
        f = {p.frequency_hz for p in asked.points}
        why = (
            f"all points are at {f.pop():g} Hz, expected two frequencies or more"
            if len(f) == 1
            else str(error)
        )
        return DiagnosisFound(number, last_step, None, " ".join(why.split()))


def _result(asked: ToDiagnose, progress: Progress) -> DiagnosisResult:
    points, damping, specimen, possible = asked.points, asked.damping, asked.specimen, asked.possible
    hammer = accepted_modes(damping.result) if damping is not None else None
    files = files_of(sweep_of(points, asked.times_s), points, specimen, asked.struck)
    found = diagnose(files, hammer, progress=progress)
    result = with_open_questions(diagnosis_from(found), found, possible).untimed
    said = [f"damped plate struck: {remark}" for one in asked.struck for remark in one.remarks]
    return result.but(warnings=(*result.warnings, *uncalibrated(points), *said))


def apart(work: Callable[[], DiagnosisFound]) -> DiagnosisFound:
    """Do the work on a thread of its own and wait: a signal reaches the waiting thread at once.

    What ends the wait ends the diagnosis's other processes too.
    """
    found: list[DiagnosisFound] = []
    failure: list[BaseException] = []

    def do() -> None:
        try:
            found.append(work())
        except BaseException as error:  # raised where it is waited for
            failure.append(error)

    thread = threading.Thread(target=do, name="diagnosis", daemon=True)
    try:
        thread.start()
        thread.join()
    except BaseException:
        end_all()
        raise
    if failure:
        raise failure[0]
    return found[0]
