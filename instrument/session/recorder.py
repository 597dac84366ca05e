"""The recorder: takes every event, seals parts as steps complete, on a thread of its own.

It is critical: once it has failed every further `record` and `check` raises, and the run ends safely. Events
are handed on to others only when they are on the disk: what a person sees as done is done.
"""

import logging
import queue
import threading
from collections.abc import Callable
from contextlib import suppress
from time import monotonic

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
        self._queue: queue.Queue[Event | None] = queue.Queue(_QUEUE)
        self._pending: list[Event] = []
        self._samples = 0
        self._failure: Exception | None = None
        self._left = False
        self._thread = threading.Thread(target=self._work, name="recorder", daemon=True)

    def __enter__(self) -> "Recorder":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._left = True
        deadline = monotonic() + _LAST_PATIENCE_S
        while self._thread.is_alive() and monotonic() < deadline:
            with suppress(queue.Full):
                self._queue.put(None, timeout=_PATIENCE_S)
                self._thread.join(deadline - monotonic())
        if self._thread.is_alive():
            self._failure = TimeoutError(f"the disk took nothing for {_LAST_PATIENCE_S:.0f} s")

    def record(self, event: Event) -> None:
        """Take an event. Raises `RigStopped` once the disk has failed."""
        self.check()
        try:
            self._queue.put(event, timeout=_PATIENCE_S)
        except queue.Full:
            raise RigStopped(
                f"{self._journal.folder}: the disk took nothing for {_PATIENCE_S:.0f} s"
            ) from None

    def check(self) -> None:
        """Raises `RigStopped` once the disk has failed."""
        if self._failure is not None:
            why = system_words(self._failure) if isinstance(self._failure, OSError) else self._failure
            raise RigStopped(f"{self._journal.folder}: recording failed: {why}")
        if not self._thread.is_alive() and not self._left:
            raise RigStopped(f"{self._journal.folder}: recording failed: its thread has ended")

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
