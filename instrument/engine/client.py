"""The engine as its client sees it. No method waits for the engine but `stop` and `close`, which say so."""

import queue
import shlex
import subprocess
import sys
import tempfile
import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from time import monotonic
from typing import IO, Literal

from instrument.engine.mailbox import Mailbox
from instrument.engine.messages import (
    AbortWanted,
    Answered,
    Decided,
    DeclineWanted,
    Ended,
    Happened,
    HoldWanted,
    Message,
    Order,
    OverruleWanted,
    RecordingBegan,
    ResumeWanted,
    RigClosed,
    RigOpened,
    Silenced,
    StopWanted,
    ended,
)
from instrument.engine.stop_path import StopPath
from instrument.engine.wire import encode, read
from instrument.errors import SWITCH_OFF
from instrument.stream.raw import SessionEnded

ENGINE = (sys.executable, "-m", "instrument.engine")
ENDS_S = 10.0
"""A run that was stopped puts its session together meanwhile; an engine that takes longer hangs."""
_SILENCES_S = 1.0
"""For word that the shaker is at rest, by whichever way."""
_HEARTBEAT = "its heartbeat ends its drive"
_AGAIN_S = 0.1
"""Between two stops: none that the run may have undone stays so for longer."""


@dataclass(frozen=True)
class Stopped:
    """How a stop by `Engine.stop` has ended."""

    silent: bool
    """The shaker says that its drive is zero. False also where no rig was open; `message` tells."""
    seconds: float
    """How long it took until then."""
    message: str
    """One line for people."""
    let_go: bool = False
    """Whether the run had let go of the shaker at rest before: that nobody answers by now is no alarm."""


class Engine:
    """One run in its own process. Methods may be called from any thread, `poll` from one.

    Make one with `start`.
    """

    def __init__(self, process: subprocess.Popen[bytes], errors: IO[bytes]) -> None:
        self._process, self._errors = process, errors
        self._received = Mailbox()
        self._commands: queue.SimpleQueue[Message | None] = queue.SimpleQueue()
        self._recorded: RecordingBegan | None = None
        self._stop_path: StopPath | None = None
        self._rig_open = self._ended_told = False
        self._left_at_rest = True
        """What the run said of the shaker as it let go of it."""
        self._run_ended = ""
        """Why, as its session says; empty where it has not ended or all was measured."""
        self._gave_end = False
        self._why_ended = ""
        self._at_rest, self._over = threading.Event(), threading.Event()
        self._stopping = threading.Lock()
        self._ending: threading.Thread | None = None
        self._threads = [
            threading.Thread(target=work, name=name, daemon=True)
            for name, work in (("from the engine", self._receive), ("to the engine", self._send))
        ]
        for thread in self._threads:
            thread.start()

    @classmethod
    def start(cls, order: Order, command: Sequence[str] = ENGINE) -> "Engine":
        """Begin a run; returns at once. A bad order comes back as `Ended`.

        Another `command` is another program that speaks as the engine does: for tests.
        """
        errors = tempfile.TemporaryFile()  # noqa: SIM115  # closed by `close`
        # In a session of its own: a Ctrl-C for the client must not break off the run before it is silent.
        process = subprocess.Popen(
            [*command],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            start_new_session=True,
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        engine = cls(process, errors)
        engine._commands.put(order)
        return engine

    @property
    def running(self) -> bool:
        """Until `Ended` has been given out by `poll`."""
        return not self._gave_end

    @property
    def pid(self) -> int:
        """Number of the engine's process."""
        return self._process.pid

    def poll(self, most: int | None = None) -> list[Message]:
        """What has come since the last time, oldest first, at most so many. Never waits.

        Where nobody polls for long, old blocks of samples are dropped (`BlocksDropped`), nothing else.
        """
        found = self._received.drain(most)
        self._gave_end = self._gave_end or any(isinstance(message, Ended) for message in found)
        return found

    def hold(self) -> None:
        """Silence the shaker and wait; `Held` tells that it is so. Of a sweep only."""
        self._commands.put(HoldWanted())

    def resume(self) -> None:
        """Go on; the step the run was held at is measured again."""
        self._commands.put(ResumeWanted())

    def decline(self) -> None:
        """Leave out the step that is being measured."""
        self._commands.put(DeclineWanted())

    def overrule(self, what: Literal["add", "end"], frequency_hz: float | None = None) -> None:
        """To a sweep that chooses its own steps: a step next, or none any more."""
        self._commands.put(OverruleWanted(what, frequency_hz))

    def abort(self) -> None:
        """End the run in order, as Ctrl-C does. What is complete is kept."""
        self._commands.put(AbortWanted())

    def mounted(self) -> None:
        """The plate asked for is mounted."""
        self._commands.put(Answered("mounted"))

    def aimed(self) -> None:
        """The laser points where it was asked to."""
        self._commands.put(Answered("aimed"))

    def changed(self) -> None:
        """What was asked for is changed."""
        self._commands.put(Answered("changed"))

    def agree(self, agreed: bool) -> None:
        """Whether what is offered is to be measured."""
        self._commands.put(Answered("agreed" if agreed else "declined"))

    def accept(self, hit: int = 0) -> None:
        """Use this hit, whatever its verdict; 0 is the last one."""
        self._commands.put(Decided("accepted", hit))

    def reject(self, hit: int = 0) -> None:
        """Leave this hit out; 0 is the last one."""
        self._commands.put(Decided("rejected", hit))

    def undo(self, hit: int = 0) -> None:
        """Back to the verdict the program gave this hit; 0 is the last one."""
        self._commands.put(Decided("undone", hit))

    def content(self) -> None:
        """The hits there are may be used."""
        self._commands.put(Answered("content"))

    def stop(self) -> Stopped:
        """Silence the shaker past whatever hangs, then end the run; also twice, also when it is over.

        Waits until the shaker says it is silent, a second or so at most: call it on a thread that may wait.
        Then the engine has `ENDS_S` to end by itself; after that its process is ended, and `Ended` says
        "died". What is sealed on the disk is kept.
        """
        began = monotonic()
        # On its way before anything else: it takes no time, and the run then ends for the right reason.
        self._commands.put(StopWanted())
        with self._stopping:
            if self._ending is None:
                self._ending = threading.Thread(target=self._see_it_end, name="engine's end", daemon=True)
                self._ending.start()
        silent, message = self._confirm()
        let_go = self._stop_path is not None and not self._rig_open and self._left_at_rest
        return Stopped(silent, monotonic() - began, message, let_go)

    def close(self) -> None:
        """Let go of the engine; a run that goes on is stopped. Waits for its end, about `ENDS_S` at most."""
        if not self._over.is_set():
            self.stop()
        self._over.wait(ENDS_S)
        self._end_process("did not end")
        self._over.wait()
        self._commands.put(None)
        for thread in (*self._threads, *filter(None, [self._ending])):
            thread.join()
        if self._stop_path is not None:
            self._stop_path.close()
        self._errors.close()

    # Stopping

    def _confirm(self) -> tuple[bool, str]:
        """Wait until one way or the other has silenced it; else end the engine, which frees the line."""
        path = self._stop_path
        if path is None:
            return False, "no rig is open: nothing was driven"
        if not self._rig_open or self._over.is_set():
            # Whoever drives the shaker by now is stopped all the same.
            problem = path.silence()
            if problem and not self._left_at_rest:
                problem = f"{SWITCH_OFF}: the run had let go of a shaker that did not stop: {problem}"
            elif problem and not self._rig_open:
                problem = (
                    f"the shaker is silent already: the run let go of it at rest; asked again: {problem}"
                )
            return not problem, problem or "the shaker is silent"
        if self._at_rest.wait(_SILENCES_S):
            return True, "the shaker is silent"
        self._end_process("did not answer")
        problem = path.silence()
        if not problem:
            return True, "the shaker is silent; the engine did not answer and was ended"
        return False, f"{SWITCH_OFF} to be sure: {problem}; {_HEARTBEAT}"

    def _see_it_end(self) -> None:
        """Stop again and again until the engine is over: a start of its own on the way must not last."""
        deadline = monotonic() + ENDS_S
        while not self._over.is_set():
            path = self._stop_path
            if path is not None and path.is_shared and self._rig_open and not path.silence():
                self._at_rest.set()
            if monotonic() > deadline:
                self._end_process(f"did not end within {ENDS_S:g} s")
            self._over.wait(_AGAIN_S)

    def _end_process(self, why: str) -> None:
        if self._process.poll() is None:
            self._why_ended = f"{why} and was ended"
            self._process.kill()
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(_SILENCES_S)

    # The pipes

    def _send(self) -> None:
        assert self._process.stdin is not None
        try:
            with self._process.stdin as pipe:
                while (message := self._commands.get()) is not None:
                    pipe.write(encode(message))
                    pipe.flush()
        except OSError:
            # The engine is over; the thread that reads tells.
            return

    def _receive(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as pipe:
            try:
                while (message := read(pipe)) is not None:
                    self._take(message)
            except (OSError, ValueError) as error:
                # What follows cannot be understood either.
                self._end_process(f"said what cannot be understood ({error})")
        self._process.wait()
        may_run = self._stop_path is not None and (self._rig_open or not self._left_at_rest)
        problem = self._stop_path.silence() if self._stop_path is not None and may_run else None
        if not self._ended_told:
            self._received.put(ended("died", self._why_it_died(problem), self._recorded))
        self._received.close()
        self._over.set()
        if self._stop_path is not None:
            self._stop_path.close()

    def _take(self, message: Message) -> None:
        match message:
            case RecordingBegan():
                self._recorded = message
            case RigOpened():
                self._stop_path = StopPath(message.shaker, self._received.put)
                self._rig_open = True
                # What a run that is resumed had ended by is past.
                self._run_ended = ""
            case RigClosed() if self._stop_path is not None:
                self._rig_open, self._left_at_rest = False, message.at_rest
                self._stop_path.close()
            case Happened(SessionEnded() as end):
                self._run_ended = end.message
            case Silenced():
                self._at_rest.set()
            case Ended():
                self._ended_told = True
        self._received.put(message)

    def _why_it_died(self, problem: str | None) -> str:
        """One line: how the process ended, the last it said, the shaker, what is left; why the run had ended.

        `problem` of the shaker, which was stopped then; None where no rig was open.
        """
        how = self._why_ended or f"ended by itself (exit status {self._process.returncode})"
        self._errors.seek(0)
        lines = self._errors.read().decode(errors="replace").split("\n")
        said = next((f": {line.strip()}" for line in reversed(lines) if line.strip()), "")
        folder = self._recorded.folder if self._recorded is not None else None
        kept = (
            f"; what is complete is in {folder}: viscorig recover {shlex.quote(str(folder))}"
            if folder
            else ""
        )
        ended = f"the engine {how}{said}"
        if self._run_ended:
            ended = f"{ended}; what came before: {self._run_ended}"
        if problem:
            return f"{SWITCH_OFF} to be sure: {problem}; {_HEARTBEAT}; {ended}{kept}"
        return f"{ended}{'; the shaker is silent' if problem is not None else ''}{kept}"
