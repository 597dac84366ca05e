"""Other programs' data and other sessions' sweeps, laid beside the session that the window shows."""

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from gui.background.task import BackgroundTask, Progress
from gui.files.file_stamp import Stamp, stamp_of
from instrument.interchange.found import Found
from instrument.interchange.given import is_session
from instrument.interchange.read_session import read_session
from instrument.interchange.readers import read_foreign


class DataBeside(QObject):
    """Read off the main thread, and kept until nobody wants them.

    Signals
    -------
    changed
        `files` holds other data now.
    renewed
        Path of a file that was written anew since it was read, and is read again.
    read
        Path of a file, and in a line what it holds.
    failed
        One line.
    busy
        A file is being read: its name; empty once it is.
    """

    changed = Signal()
    renewed = Signal(Path)
    read = Signal(Path, str)
    failed = Signal(str)
    busy = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.files: dict[Path, Found] = {}
        self._stamps: dict[Path, Stamp | None] = {}
        """Of files, as they were read last."""
        self._works: dict[Path, _Reading] = {}

    @property
    def reading(self) -> bool:
        """Whether a file is being read."""
        return bool(self._works)

    def lay(self, path: Path) -> None:
        """One more file, or the same again. Returns at once."""
        self.busy.emit(path.name)
        self._works[path] = work = _Reading(path, self)
        work.done.connect(self._read)
        work.failed.connect(self._not_read)
        work.start()

    def take_away(self) -> None:
        """All of them."""
        self.files.clear()
        self.changed.emit()

    def close(self) -> None:
        """Let go of everything."""
        for work in self._works.values():
            work.close()

    def _read(self, found: object) -> None:
        work = self.sender()
        assert isinstance(work, _Reading)
        assert isinstance(found, Found)
        self._forget(work)
        if self._stamps.get(work.path, work.stamp) != work.stamp:
            self.renewed.emit(work.path)
        self.files[work.path], self._stamps[work.path] = found, work.stamp
        counts = (
            *((len(found.sweeps), "sweep"), (len(found.frfs), "FRF"), (len(found.hits), "hit")),
            (len(found.modes), "table of modes"),
        )
        self.read.emit(work.path, ", ".join(_counted(n, what) for n, what in counts if n))
        self.changed.emit()

    def _not_read(self, message: str) -> None:
        work = self.sender()
        assert isinstance(work, _Reading)
        self._forget(work)
        self.failed.emit(message)

    def _forget(self, work: "_Reading") -> None:
        self._works.pop(work.path, None)
        self.busy.emit("")
        work.deleteLater()


def _counted(n: int, what: str) -> str:
    first, *rest = what.split(" ", 1)
    return " ".join([str(n), first + ("s" if n > 1 else ""), *rest])


class _Reading(BackgroundTask[Found]):
    """Of another program's file, or another session."""

    def __init__(self, path: Path, parent: QObject) -> None:
        super().__init__(self._read_file, parent)
        self.path, self.stamp = path, stamp_of(path)

    def _read_file(self, _: Progress) -> Found:
        return read_session(self.path) if is_session(self.path) else read_foreign(self.path)
