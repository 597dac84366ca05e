"""A whole experiment: hammer test, calibration, sweep, live identification, diagnosis, one session."""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from threadpoolctl import threadpool_limits

from drivers.errors import DriverError
from instrument.check.faults import experiment_objections
from instrument.check.follow_up_remark import follow_up_remarks
from instrument.check.forecast import Forecast
from instrument.check.sensors import sensor_remarks
from instrument.check.work import planned_regions, planned_work
from instrument.errors import BadInput, RigStopped, ShakerNotSilent, StoppedByUser, fault_words, system_words
from instrument.progress import Progress, quiet
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.run.keeping import finish_session, kept, open_journal
from instrument.run.live_diagnosis import Diagnoser, diagnose_points
from instrument.run.live_fit import Fitter, fit_points
from instrument.run.part import Part
from instrument.run.session_run import RunRequest, SessionRun
from instrument.session.configuration import Experiment
from instrument.session.recorder import Recorder
from instrument.session.storage import part_events
from instrument.stream.derived import DampingFound, DiagnosisFound, FitUpdated, PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import BlockAcquired

log = logging.getLogger(__name__)

Watch = Callable[[list[Event]], None]
"""Told of events once they are on the disk, on the recorder's thread."""


@dataclass(frozen=True)
class Finished:
    """What a run has left when it ends."""

    session: Path
    damping: DampingFound | None
    fit: FitUpdated | None
    points: tuple[PointMeasured, ...]
    diagnosis: DiagnosisFound | None = None
    """None where the sweep was not run, or no law could be identified from it."""
    following: tuple[Event, ...] = ()
    """Every diagnosis, and what was proposed and decided after it."""


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
    request = RunRequest(
        experiment, parts, control or RunControl(), fit, diagnose, companion or Companion(), progress
    )
    # One thread for all sums: with several, their last bit would depend on what else runs.
    with threadpool_limits(1, "blas"):
        return _run(request, out, resume, watch)


def _run(request: RunRequest, out: Path, resume: Path | None, watch: Watch | None) -> Finished:
    experiment, parts, companion = request.experiment, request.parts, request.companion
    with request.progress("forecasting the sweep"):
        forecast = Forecast.of(experiment.the_specimen())
        objections = experiment_objections(experiment, forecast, parts)
    if objections:
        more = f" (and {len(objections) - 1} more: viscorig check lists them)" if len(objections) > 1 else ""
        raise BadInput(objections[0] + more)
    command = parts[0] if len(parts) == 1 else "run"
    journal, name = open_journal(experiment, out, resume, command)
    path = journal.folder.parent / f"{name}.h5"
    begun = (command, str(experiment.path))
    session: SessionRun | None = None
    try:
        entries = journal.entries()
        earlier = [event for e in entries for event in part_events(journal.folder / e.file)]
        companion.recording(journal.folder, path)
        unfollowed = follow_up_remarks(experiment) if "sweep" in parts else []
        for remark in (*sensor_remarks(experiment.rig, datetime.now(UTC).date()), *unfollowed):
            log.warning("%s", remark)
        swept = planned_regions(experiment, forecast) if "sweep" in parts else ()
        companion.planned(planned_work(experiment, forecast, parts), swept)
        for event in earlier:
            if not isinstance(event, BlockAcquired):
                companion.happened(event)
        session = SessionRun(request, journal, forecast, earlier)
        with Recorder(journal, entries, watch) as recorder:
            session.run(recorder)
        recorder.check()
        finish_session(journal, path)
    except (Exception, KeyboardInterrupt) as error:
        first = request.control.ends(error)
        # The same again would want the same memory; a diagnosis alone wants less.
        alone = session is not None and session.lacks_fits_alone and isinstance(first, MemoryError)
        words = kept(journal, path, begun, diagnosable=alone)
        raise _told(first, journal.folder, words) from first
    finally:
        journal.unlock()
    points = tuple(session.analysis.points)
    damping, following = session.analysis.damping, tuple(session.following)
    return Finished(path, damping, session.fit, points, session.diagnosis, following)


def _told(error: BaseException, folder: Path, kept_words: str) -> Exception:
    """How a run that ended by this is told of, with what is kept of it."""
    said = " ".join(str(error).split())
    match error:
        case OSError():
            why = f"{error.filename or folder}: {system_words(error)}"
            return RigStopped(f"{' '.join(why.split())}; {kept_words}")
        case ShakerNotSilent():
            return ShakerNotSilent(f"{said}; {kept_words}")
        case RigStopped() | DriverError():
            return RigStopped(f"{said}; {kept_words}")
        case KeyboardInterrupt():
            return StoppedByUser(kept_words)
        case BadInput():
            return BadInput(f"{said}; {kept_words}")
    # A fault of this program: what was measured is kept all the same.
    log.debug("internal error", exc_info=error)
    return RigStopped(f"{fault_words(error)}; {kept_words}")
