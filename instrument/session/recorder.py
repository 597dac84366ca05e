"""The recorder: takes every event, seals parts as steps complete, on a thread of its own.

It is critical: once it has failed every further `record` and `check` raises, and the run ends safely. Events
are handed on to others only when they are on the disk: what a person sees as done is done.

A stop by a signal may come anywhere in `record`, and the end of the run is recorded after it. So nothing here
asks `Thread` whether it lives (broken off, it takes a living one for ended), and no lock is taken in Python.
"""

import logging
import queue
import threading
from collections.abc import Callable
from time import monotonic, sleep

from instrument.errors import RigStopped, system_words
from instrument.session.journal import Entry, SessionJournal
from instrument.session.storage import write_part
from instrument.stream.derived import (
    CalibrationFound,
    DampingFound,
    DiagnosisFound,
    FitUpdated,
    HitJudged,
    HitRevised,
    LoopChecked,
    PointMeasured,
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
    SegmentEnded,
    SessionEnded,
)

log = logging.getLogger(__name__)

_SEALING = (
    LoopChecked,
    PointMeasured,
    CalibrationFound,
    DampingFound,
    HitJudged,
    HitRevised,
    StruckFound,
    FitStarted,
    FitFailed,
    FitUpdated,
    DiagnosisStarted,
    DiagnosisFound,
    FollowUpProposed,
    FollowUpDecided,
    FollowUpEnded,
    SegmentEnded,
    SessionEnded,
)
"""After one of these everything up to it is sealed."""  # fmt: skip
_MOST_SAMPLES = 2_000_000
"""Of all channels together: memory stays flat however long nothing completes."""
_QUEUE = 256
"""Events in flight; beyond that the run waits for the disk."""
_LOOK_S = 0.002
"""Between two looks at a queue that full: less than the disk takes for a part."""
_PATIENCE_S = 10.0
"""With a queue that full: no disk that works is away for so long."""
_LAST_PATIENCE_S = 120.0
"""For what is left when a run ends: nobody waits for the shaker then."""


class Recorder:
    """Records the events and samples of one session. Use as a context: leaving it seals what is left."""

    def __init__(
        self, journal: SessionJournal, parts: list[Entry], sealed: Callable[[list[Event]], None] | None = None
    ) -> None:
        self._journal, self._parts = journal, list(parts)
        self._sealed = sealed
        self._queue: queue.SimpleQueue[Event | None] = queue.SimpleQueue()
        self._pending: list[Event] = []
        self._samples = 0
        self._failure: Exception | None = None
        self._stopped: RigStopped | None = None
        self._left, self._works = False, True
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)

    def __enter__(self) -> "Recorder":
        self._thread.start()
        return self

    def __exit__(self, _: object, error: BaseException | None, *__: object) -> None:
        """Where something else ended the run, a failure is said here: nobody asks `check` any more."""
        self._left = True
        self._queue.put(None)
        deadline = monotonic() + _LAST_PATIENCE_S
        while self._works and monotonic() < deadline:
            sleep(_LOOK_S)
        if self._works:
            self._failure = TimeoutError(f"the disk took nothing for {_LAST_PATIENCE_S:.0f} s")
        if error is not None and self._failure is not None and error is not self._stopped:
            log.warning("%s", self._stop(self._failure))

    def record(self, event: Event) -> None:
        """Take an event. Raises `RigStopped` once the disk has failed."""
        self.check()
        deadline = monotonic() + _PATIENCE_S
        while self._queue.qsize() >= _QUEUE:
            self.check()
            if monotonic() > deadline:
                raise RigStopped(f"{self._journal.folder}: the disk took nothing for {_PATIENCE_S:.0f} s")
            sleep(_LOOK_S)
        self._queue.put(event)

    def check(self) -> None:
        """Raises `RigStopped` once the disk has failed."""
        if self._failure is not None:
            raise self._stop(self._failure)
        if not self._works and not self._left:
            raise RigStopped(f"{self._journal.folder}: recording failed: its thread has ended")

    def _stop(self, failure: Exception) -> RigStopped:
        """What is said of a failure, the same whenever it is asked for."""
        if self._stopped is None:
            why = system_words(failure) if isinstance(failure, OSError) else failure
            self._stopped = RigStopped(f"{self._journal.folder}: recording failed: {why}")
        return self._stopped

    def _run(self) -> None:
        try:
            self._work()
        except Exception as error:  # a thread that ends says why to whoever records
            self._failure = error
        finally:
            self._works = False

    def _work(self) -> None:
        while (event := self._queue.get()) is not None:
            if self._failure is None:
                self._take(event)
        if self._failure is None:
            self._try_to_seal()

    def _take(self, event: Event) -> None:
        if isinstance(event, AcquisitionBegan):
            # Blocks of one part have the same channels.
            self._try_to_seal()
        self._pending.append(event)
        if isinstance(event, BlockAcquired):
            self._samples += event.counts.size
        if isinstance(event, _SEALING) or self._samples > _MOST_SAMPLES:
            self._try_to_seal()

    def _try_to_seal(self) -> None:
        try:
            self._seal()
        except Exception as error:  # whatever it is, the run must hear of it: `check` raises it
            self._failure = error

    def _seal(self) -> None:
        if not self._pending:
            return
        events, self._pending, self._samples = self._pending, [], 0
        number = len(self._parts) + 1
        name = f"part-{number:06d}.h5"
        digest = write_part(self._journal.folder / name, events)
        steps = tuple(e.step for e in events if isinstance(e, PointMeasured))
        entry = Entry(number, name, digest, len(events), steps)
        self._journal.add(entry)
        self._parts.append(entry)
        self._tell(events)

    def _tell(self, events: list[Event]) -> None:
        """A terminal that is gone, or a plot that fails, is told no more; the recording goes on."""
        if self._sealed is None:
            return
        try:
            self._sealed(events)
        except (Exception, SystemExit) as error:  # rich makes a SystemExit of a broken pipe
            self._sealed = None
            log.warning("no longer told of events: %s", error)
