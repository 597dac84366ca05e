"""The live identification: on a thread of its own, with the newest points, its results back as events."""

import logging
import threading
from collections.abc import Callable

from pydantic import ValidationError
from threadpoolctl import threadpool_limits

from fitting.errors import FittingError
from fitting.structures import AnySpecimen
from instrument.errors import RigStopped, fault_words
from instrument.facts.identification import IdentificationResult
from instrument.files.hammer_file import accepted_modes
from instrument.finding.identification import identify
from instrument.interchange.files_of import files_of
from instrument.progress import Progress, quiet
from instrument.results.identification_from import identification_from
from instrument.session.points import sweep_of, uncalibrated
from instrument.stream.derived import DampingFound, FitUpdated, PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import FitFailed, FitStarted

log = logging.getLogger(__name__)

Fitter = Callable[[int, int, list[PointMeasured], DampingFound | None, AnySpecimen], FitUpdated]
"""Number, last step, points, hammer test, specimen."""


def fit_points(
    number: int,
    last_step: int,
    points: list[PointMeasured],
    damping: DampingFound | None,
    specimen: AnySpecimen,
    progress: Progress = quiet,
) -> FitUpdated:
    """Identify from all points up to a step, jointly with the hammer test. Pure: the same in a replay."""
    used = [p for p in points if p.step <= last_step]
    try:
        # One thread: sums in another order would differ in the last bit.
        with threadpool_limits(1):
            return FitUpdated(number, last_step, _result(used, damping, specimen, progress))
    except (FittingError, ValidationError, ValueError, ArithmeticError) as error:
        # Data may be such that no fit is possible: said, and the measurement goes on.
        log.debug("no fit of points up to step %d", last_step, exc_info=True)
        return FitUpdated(number, last_step, None, " ".join(str(error).split()))


def _result(
    used: list[PointMeasured], damping: DampingFound | None, specimen: AnySpecimen, progress: Progress
) -> IdentificationResult:
    modes = accepted_modes(damping.result) if damping is not None else None
    files = files_of(sweep_of(used), used, specimen)
    result = identification_from(identify(files, progress=progress, hammer=modes)).untimed
    return _with_temperature(result.but(warnings=(*result.warnings, *uncalibrated(used))), used)


def _with_temperature(result: IdentificationResult, used: list[PointMeasured]) -> IdentificationResult:
    """At which the law holds, where a sensor was there."""
    known = [p.temperature_c for p in used if p.temperature_c is not None]
    if not known:
        return result
    mean, ends = sum(known) / len(known), (min(known), max(known))
    return result.but(temperature_c=mean, temperature_range_c=ends)


class LiveFit:
    """Fits while the run goes on. Points may come faster than fits: then fits are skipped, never points.

    Use as a context around the sweep.
    """

    def __init__(
        self, specimen: AnySpecimen, emit: Callable[[Event], object], fit: Fitter, number: int = 0
    ) -> None:
        """`number` is that of the last fit before."""
        self._specimen, self._emit = specimen, emit
        self._fit = fit
        self._wake = threading.Condition()
        self._newest: tuple[list[PointMeasured], DampingFound | None] | None = None
        self._ended = False
        self._failure: Exception | None = None
        """Of the newest points; those before may have been fitted."""
        self.latest: FitUpdated | None = None
        self.number = number
        self._thread = threading.Thread(target=self._work, name="live fit", daemon=True)
        self._thread.start()

    def offer(self, points: list[PointMeasured], damping: DampingFound | None) -> None:
        """Points there are now. Returns at once."""
        with self._wake:
            self._newest = list(points), damping
            self._wake.notify()

    def __enter__(self) -> "LiveFit":
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        """Wait for the fit of the newest points; after an error wait for nothing."""
        with self._wake:
            self._ended = True
            if kind is not None:
                self._newest = None
            self._wake.notify()
        if kind is None:
            self._thread.join()
            if self._failure is not None:
                raise self._failure

    def _work(self) -> None:
        while (task := self._next()) is not None:
            points, damping = task
            last = max(p.step for p in points)
            if self.latest is not None and self.latest.last_step == last:
                continue
            self.number += 1
            try:
                self._fit_one(last, points, damping)
            except RigStopped as error:  # the recorder failed, of which the run hears by itself
                self._failure = error
                return

    def _fit_one(self, last: int, points: list[PointMeasured], damping: DampingFound | None) -> None:
        """Up to a step. Raises `RigStopped` where nothing is recorded any more."""
        try:
            self._emit(FitStarted(self.number, last))
            self.latest = self._fit(self.number, last, points, damping, self._specimen)
            self._emit(self.latest)
            self._failure = None
        except RigStopped:
            raise
        except Exception as error:  # raised on leaving: a fit must not end a measurement
            log.debug("internal error", exc_info=True)
            # Without its frames: they would keep the memory that the next fit may need.
            self._failure = error.with_traceback(None)
            log.warning("no fit of the points up to step %d: %s", last, fault_words(error))
            self._tell_failed(fault_words(error))

    def _tell_failed(self, message: str) -> None:
        """Raises `RigStopped` as `_fit_one` does; what else fails here must not end the fits to come."""
        try:
            self._emit(FitFailed(self.number, message))
        except RigStopped:
            raise
        except Exception as error:
            log.debug("internal error", exc_info=True)
            log.warning("that fit %d failed is not recorded: %s", self.number, fault_words(error))

    def _next(self) -> tuple[list[PointMeasured], DampingFound | None] | None:
        with self._wake:
            self._wake.wait_for(lambda: self._newest is not None or self._ended)
            task, self._newest = self._newest, None
            return task
