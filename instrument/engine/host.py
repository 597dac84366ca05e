"""The engine's side: goes along with the run, tells the client, and does what the client asks.

One rule: the thread that listens to the client does nothing that can hang but stopping the shaker. So a stop
gets through whatever the run's own thread is waiting for.
"""

import logging
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from time import monotonic, sleep
from typing import BinaryIO

from drivers.errors import DriverError
from fitting.progress import Report
from instrument.check.piece import Region, TimedPiece
from instrument.engine.asking import HelpedOperator, RemoteOperator
from instrument.engine.interruption import Interruption
from instrument.engine.mailbox import Mailbox
from instrument.engine.messages import (
    AbortWanted,
    Answered,
    Decided,
    DeclineWanted,
    Happened,
    HoldWanted,
    Logged,
    Message,
    OverruleWanted,
    Planned,
    Progressed,
    RecordingBegan,
    ResumeWanted,
    RigClosed,
    RigOpened,
    Silenced,
    StopWanted,
)
from instrument.engine.stoppable import StoppableShaker
from instrument.engine.wire import read
from instrument.errors import RigStopped
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.run.operator import Operator, SimulatedOperator
from instrument.run.rig import Rig
from instrument.stream.event import Event

log = logging.getLogger(__name__)

_PROGRESS_S = 0.1
"""Between two words on the progress of one piece of work."""
_ORPHAN_S = 180.0
"""For a run to end after its client has: longer than the recorder waits for a slow disk."""


class Host(Companion):
    """Goes along with one run and tells its client of it."""

    def __init__(self, *, ask_content: bool) -> None:
        self.control, self.mailbox = RunControl(), Mailbox()
        self.interruption = Interruption(self.control)
        self.recorded: RecordingBegan | None = None
        """Where the run is recorded, once it is."""
        self._operator = RemoteOperator(self.mailbox.put, ask_content)
        self._shaker: StoppableShaker | None = None
        self._silencing = threading.Lock()
        """The rig is not let go of before a shaker that is being stopped is at rest."""

    # Beside the run

    def recording(self, folder: Path, session: Path) -> None:
        """Told to the client."""
        self.recorded = RecordingBegan(folder, session)
        self.mailbox.put(self.recorded)

    def planned(self, work: tuple[TimedPiece, ...], regions: tuple[Region, ...]) -> None:
        """Told to the client."""
        self.mailbox.put(Planned(work, regions))

    def happened(self, event: Event) -> None:
        """Told to the client."""
        self.mailbox.put(Happened(event))

    @contextmanager
    def with_rig(self, rig: Rig) -> Iterator[Rig]:
        """A rig whose shaker can be stopped past the run, and whose operator is the client."""
        operator: Operator = self._operator
        if isinstance(rig.operator, SimulatedOperator):
            operator = HelpedOperator(rig.operator, self._operator, in_virtual_time=rig.in_virtual_time)
        self._shaker = StoppableShaker(rig.shaker)
        self.mailbox.put(RigOpened(rig.document.shaker))
        try:
            yield replace(rig, shaker=self._shaker, operator=operator)
        finally:
            with self._silencing:
                self._shaker = None
            self.mailbox.put(RigClosed(at_rest=not self.control.ended_loud))

    @contextmanager
    def progress(self, name: str) -> Iterator[Report]:
        """`instrument.progress.Progress`, told to the client."""
        told = [monotonic()]
        self.mailbox.put(Progressed(name, 0.0))

        def report(fraction: float) -> None:
            if monotonic() - told[0] >= _PROGRESS_S:
                told[0] = monotonic()
                self.mailbox.put(Progressed(name, min(max(float(fraction), 0.0), 1.0)))

        try:
            yield report
        finally:
            self.mailbox.put(Progressed(name, 1.0, ended=True))

    # What the client asks

    def listen(self, commands: BinaryIO) -> None:
        """Until the client has ended; then the run ends too."""
        try:
            while (message := read(commands)) is not None:
                self._do(message)
        except (OSError, ValueError) as error:
            log.error("the client cannot be understood: %s", error)
        why = "the program that watched the run has ended"
        self._end(RigStopped(why))
        self.control.abort(why)
        # Nobody is left to end a process that hangs even so.
        sleep(_ORPHAN_S)
        os._exit(1)

    def _do(self, message: Message) -> None:
        match message:
            case HoldWanted():
                self.control.hold()
            case ResumeWanted():
                self.control.resume()
            case DeclineWanted():
                self.control.decline()
            case OverruleWanted():
                self.control.overrule(message.what, message.frequency_hz)
            case Answered() | Decided():
                self._operator.answer(message)
            case AbortWanted() | StopWanted():
                self._end(KeyboardInterrupt())
            case _:
                log.warning("not understood: %s", type(message).__name__)

    def _end(self, error: BaseException) -> None:
        """Break off the run, and silence the shaker here too: the run's own thread may not come to it."""
        with self._silencing:
            self.interruption.ask(error)
            if self._shaker is None:
                return
            try:
                self._shaker.stop_for_good()
            except DriverError as problem:
                log.error("not stopped: %s", problem)
            else:
                self.mailbox.put(Silenced())


class LogToClient(logging.Handler):
    """What this program logs, told to the client."""

    def __init__(self, mailbox: Mailbox) -> None:
        super().__init__(logging.INFO)
        self._mailbox = mailbox

    def emit(self, record: logging.LogRecord) -> None:
        """One line."""
        utc = datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds")
        self._mailbox.put(Logged(utc, record.levelname, " ".join(record.getMessage().split())))
