"""Long work off the main thread, with progress, and cancelled where nobody wants it any more.

Reading files goes to a thread (`BackgroundTask`). What needs the processor for long, a fit or a diagnosis,
goes to a process (`BackgroundCommand`): the interpreter lets one thread compute at a time, and the window has
to be that one.

Connect bound methods of objects that live in the main thread, and nothing else: a plain function would be
called in the thread that does the work.
"""

import json
import sys
import threading
from collections.abc import Callable
from typing import Generic, TypeVar

from PySide6.QtCore import QObject, QProcess, QProcessEnvironment, Qt, Signal

from drivers.errors import DriverError
from fitting.errors import FittingError
from instrument.errors import BadInput
from instrument.facts.result import Result
from instrument.processes.background import VARIABLE as BACKGROUND
from instrument.progress import LINES

T = TypeVar("T")

Progress = Callable[[float], None]
"""Told the fraction done, 0 to 1. Raises `Cancelled` where the work is no longer wanted."""
_ENDS_MS = 2000


class Cancelled(Exception):
    """The work is no longer wanted."""


class BackgroundTask(QObject, Generic[T]):
    """A function in another thread. One of `done`, `failed`, `cancelled` comes, in the main thread.

    Parameters
    ----------
    function : callable
        Takes a `Progress`; its result goes with `done`. What it raises goes with `failed`, as one line.
    """

    done = Signal(object)
    failed = Signal(str)
    cancelled = Signal()
    progressed = Signal(float)
    _left = Signal(object, object)

    def __init__(self, function: Callable[[Progress], T], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._function = function
        self._unwanted = threading.Event()
        self.over = False
        self._thread = threading.Thread(target=self._run, name="work", daemon=True)
        self._left.connect(self._finish, Qt.ConnectionType.QueuedConnection)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    @property
    def unwanted(self) -> bool:
        """Whether it was cancelled: its result is not told."""
        return self._unwanted.is_set()

    def cancel(self) -> None:
        """Ask it to end; it does at its next word of progress. Its result is not told."""
        self._unwanted.set()

    def close(self) -> None:
        """Cancel, and wait a little for its end."""
        self.cancel()
        if self._thread.is_alive():
            self._thread.join(_ENDS_MS / 1000)

    def _run(self) -> None:
        result, error = None, None
        try:
            self._progress(0.0)
            result = self._function(self._progress)
        except Exception as caught:  # told in the main thread, whatever it is
            error = caught
        try:
            self._left.emit(result, error)
        except RuntimeError:
            # The window has gone meanwhile, and its objects with it.
            return

    def _progress(self, fraction: float) -> None:
        if self._unwanted.is_set():
            raise Cancelled
        self.progressed.emit(fraction)

    def _finish(self, result: object, error: Exception | None) -> None:
        self.over = True
        if self._unwanted.is_set() or isinstance(error, Cancelled):
            self.cancelled.emit()
        elif error is not None:
            self.failed.emit(said_of_fault(error))
        else:
            self.done.emit(result)


class BackgroundCommand(QObject):
    """A `viscorig` command in a process of its own; what it writes as JSON, a `result`, goes with `done`.

    So the window has the same numbers as the command line. Of several kinds that its result may be of it is
    the first that can be read. One of `done`, `failed`, `cancelled` comes. `progressed` tells what is being
    worked at and the fraction of it that is done.

    Parameters
    ----------
    arguments : list of str
        The command and what it is given.
    result : type or tuple of type
        What it writes.
    program : tuple of str
        What runs commands.
    """

    done = Signal(object)
    failed = Signal(str)
    cancelled = Signal()
    progressed = Signal(str, float)

    def __init__(
        self,
        arguments: list[str],
        result: type[Result] | tuple[type[Result], ...],
        parent: QObject | None = None,
        *,
        program: tuple[str, ...] = (sys.executable, "-m", "instrument.cli"),
    ) -> None:
        super().__init__(parent)
        self._results = result if isinstance(result, tuple) else (result,)
        self._command = arguments[0]
        self._unwanted = False
        self.over = False
        self._process = QProcess(self)
        self._process.setProgram(program[0])
        self._process.setArguments([*program[1:], *arguments, "--json", "-"])
        environment = QProcessEnvironment.systemEnvironment()
        environment.insert(LINES, "lines")
        environment.insert(BACKGROUND, "1")
        # With a thread for every processor it would take the window's own.
        environment.insert("OPENBLAS_NUM_THREADS", "1")
        self._process.setProcessEnvironment(environment)
        self._said: list[str] = []
        self._rest = ""
        self._process.readyReadStandardError.connect(self._hear)
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._broken)

    @property
    def said(self) -> list[str]:
        """Every line it wrote for people, so far."""
        return list(self._said)

    def start(self) -> None:
        """Begin."""
        self._process.start()

    def cancel(self) -> None:
        """End it at once."""
        self._unwanted = True
        self._process.kill()

    def close(self) -> None:
        """End it and wait until it has."""
        if self._process.state() != QProcess.ProcessState.NotRunning:
            self.cancel()
            self._process.waitForFinished(_ENDS_MS)

    def _hear(self) -> None:
        """Progress is told, the rest kept for the case that it fails."""
        text = self._rest + bytes(self._process.readAllStandardError().data()).decode(errors="replace")
        *lines, self._rest = text.split("\n")
        if self.over:
            lines.append(self._rest)
        for line in filter(None, map(str.strip, lines)):
            try:
                told = json.loads(line)
                self.progressed.emit(told["work"], told["fraction"])
            except (ValueError, TypeError, KeyError):
                self._said.append(line)

    def _finished(self, status: int) -> None:
        self.over = True
        if self._unwanted:
            self.cancelled.emit()
            return
        self._hear()
        if status != 0:
            why = self._said[-1].removeprefix("viscorig: ") if self._said else "it failed"
            self.failed.emit(self._without_option(why))
            return
        said = bytes(self._process.readAllStandardOutput().data())
        for kind in self._results:
            try:
                found = kind.model_validate_json(said)
            except ValueError:
                continue
            self.done.emit(found)
            return
        self.failed.emit("it gave no result")

    def _without_option(self, said: str) -> str:
        """A window has no options: they go by the words on its buttons, or go to the command line."""
        from instrument.files.plausible import INSIST

        said = said.replace("--hammer", "a hammer test")
        return said.replace(
            INSIST, f"correct it (a terminal goes on all the same: viscorig {self._command} --force)"
        )

    def _broken(self, error: QProcess.ProcessError) -> None:
        if error == QProcess.ProcessError.FailedToStart:
            self.over = True
            self.failed.emit(self._process.errorString())


def said_of_fault(error: Exception) -> str:
    """One line for people."""
    line = " ".join(str(error).split())
    if isinstance(error, (BadInput, FittingError, DriverError)):
        return line
    if isinstance(error, OSError):
        return f"{error.filename or 'file'}: {error.strerror or line}"
    return f"internal error, {type(error).__name__}: {line}"
