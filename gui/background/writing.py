"""Files that are written in the background, and the one line that is said of each."""

from typing import Any

from PySide6.QtCore import QObject, Signal

from gui.background.task import BackgroundCommand, BackgroundTask


class Writing(QObject):
    """Any number at a time.

    Signals
    -------
    done, failed
        One line: what was written, or why it was not.
    """

    done = Signal(str)
    failed = Signal(str)

    def write(self, work: BackgroundCommand | BackgroundTask[Any]) -> None:
        """Begin; returns at once."""
        work.done.connect(self._written)
        work.failed.connect(self._not_written)
        work.start()

    def said_of(self, found: object) -> str:
        """The line of what the work found."""
        return f"wrote {found}"

    def _written(self, found: object) -> None:
        self._forget()
        self.done.emit(self.said_of(found))

    def _not_written(self, message: str) -> None:
        self._forget()
        self.failed.emit(message)

    def _forget(self) -> None:
        work = self.sender()
        if isinstance(work, BackgroundCommand | BackgroundTask):
            work.deleteLater()
