"""The live identification: on a thread of its own, with the newest points, its results back as events."""

import threading
from collections.abc import Callable

from pydantic import ValidationError
from threadpoolctl import threadpool_limits

from fitting.errors import FittingError
from fitting.specimen import Specimen
from instrument.files.hammer_file import accepted_modes
from instrument.models.identification import identify
from instrument.progress import Progress, quiet
from instrument.results.identification_facts import bare_plate_facts, identification_facts
from instrument.session.points import sweep_of, uncalibrated
from instrument.stream.derived import DampingFound, FitUpdated, PointMeasured
from instrument.stream.event import Event
from instrument.stream.jsonable import to_jsonable
from instrument.stream.raw import FitStarted

Fitter = Callable[[int, int, list[PointMeasured], DampingFound | None, Specimen], FitUpdated]
"""Number, last step, points, hammer test, specimen."""
_SECONDS = ("seconds", "setup_seconds", "validation_seconds")


def fit_points(
    number: int,
    last_step: int,
    points: list[PointMeasured],
    damping: DampingFound | None,
    specimen: Specimen,
    progress: Progress = quiet,
) -> FitUpdated:
    """Identify from all points up to a step, jointly with the hammer test. Pure: the same in a replay."""
    used = [p for p in points if p.step <= last_step]
    try:
        # One thread: sums in another order would differ in the last bit.
        with threadpool_limits(1):
            return FitUpdated(number, last_step, _facts(used, damping, specimen, progress))
    except (FittingError, ValidationError, ValueError, ArithmeticError) as error:
        # Data may be such that no fit is possible: said, and the measurement goes on.
        return FitUpdated(number, last_step, {}, " ".join(str(error).split()))


def _facts(
    used: list[PointMeasured], damping: DampingFound | None, specimen: Specimen, progress: Progress
) -> dict[str, object]:
    modes = accepted_modes(damping.facts_json) if damping is not None else None
    sweep = sweep_of(used)
    found = identify(sweep, specimen, progress=progress, hammer=modes)
    hammer = {"hammer": bare_plate_facts(found.bare, specimen)} if found.bare is not None else {}
    facts = identification_facts(found, sweep)
    facts["warnings"] += uncalibrated(used)
    kept = {key: value for key, value in facts.items() if key not in _SECONDS}
    return dict(to_jsonable({**kept, **hammer, **_temperature(used)}))


def _temperature(used: list[PointMeasured]) -> dict[str, object]:
    """At which the law holds, where a sensor was there."""
    known = [p.temperature_c for p in used if p.temperature_c is not None]
    if not known:
        return {}
    return {"temperature_c": sum(known) / len(known), "temperature_range_c": [min(known), max(known)]}


class LiveFit:
    """Fits while the run goes on. Points may come faster than fits: then fits are skipped, never points.

    Use as a context around the sweep.
    """

    def __init__(self, specimen: Specimen, emit: Callable[[Event], object], fit: Fitter) -> None:
        self._specimen, self._emit = specimen, emit
        self._fit = fit
        self._wake = threading.Condition()
        self._newest: tuple[list[PointMeasured], DampingFound | None] | None = None
        self._ended = False
        self._failure: Exception | None = None
        self.latest: FitUpdated | None = None
        self._number = 0
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
        try:
            while (task := self._next()) is not None:
                points, damping = task
                last = max(p.step for p in points)
                if self.latest is not None and self.latest.last_step == last:
                    continue
                self._number += 1
                self._emit(FitStarted(self._number, last))
                self.latest = self._fit(self._number, last, points, damping, self._specimen)
                self._emit(self.latest)
        except Exception as error:  # raised on leaving: a fit must not end a measurement
            self._failure = error

    def _next(self) -> tuple[list[PointMeasured], DampingFound | None] | None:
        with self._wake:
            self._wake.wait_for(lambda: self._newest is not None or self._ended)
            task, self._newest = self._newest, None
            return task
