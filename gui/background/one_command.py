"""One command at a time in a process of its own: another one takes its place, and it may be dropped."""

from PySide6.QtCore import QObject, Signal

from gui.background.task import BackgroundCommand
from instrument.facts.result import Result


class OneCommand(QObject):
    """Of several commands asked for, the last one's end is told.

    Signals
    -------
    done
        The result; nothing runs any more.
    failed
        One line; nothing runs any more.
    progressed
        What is being worked at, and the fraction of it that is done.
    """

    done = Signal(object)
    failed = Signal(str)
    progressed = Signal(str, float)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.said: list[str] = []
        """Every line that the last one that failed wrote for people."""
        self._command: BackgroundCommand | None = None

    @property
    def running(self) -> bool:
        """Whether one goes on."""
        return self._command is not None

    def start(self, arguments: list[str], result: type[Result] | tuple[type[Result], ...]) -> None:
        """Begin; the one before is dropped. Arguments and results are those of `BackgroundCommand`."""
        self.drop()
        self._command = BackgroundCommand(arguments, result, self)
        self._command.done.connect(self._done)
        self._command.failed.connect(self._failed)
        self._command.progressed.connect(self.progressed)
        self._command.start()

    def drop(self) -> None:
        """End what is running, and wait until it has; nothing of it is told."""
        command = self._let_go()
        if command is not None:
            command.close()

    def _done(self, found: object) -> None:
        self._let_go()
        self.done.emit(found)

    def _failed(self, message: str) -> None:
        command = self._let_go()
        self.said = command.said if command is not None else []
        self.failed.emit(message)

    def _let_go(self) -> BackgroundCommand | None:
        command, self._command = self._command, None
        if command is not None:
            command.disconnect(self)
            command.deleteLater()
        return command
