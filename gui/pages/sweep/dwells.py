"""Reads the samples of a point's dwell from the session file, off the main thread, one at a time."""

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from gui.background.task import BackgroundTask, Progress
from instrument.session.dwell import DwellSamples, dwell_of
from instrument.session.storage import SessionFile


class Dwells(QObject):
    """Reads the samples of a step's dwell; only the last wish counts.

    Signals
    -------
    read : (int, DwellSamples)
        The step and its samples.
    failed : str
        Why there are none.
    """

    read = Signal(int, object)
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._wanted: tuple[Path, int] | None = None
        self._work: _DwellReading | None = None

    @property
    def busy(self) -> bool:
        """Whether something is being read."""
        return self._work is not None

    def want(self, path: Path | None, step: int) -> None:
        """Read this one next; None: nothing."""
        self._wanted = (path, step) if path is not None else None
        self._next()

    def rest(self) -> None:
        """Read nothing any more; a file that is being read is let go of."""
        self._wanted = None
        if self._work is not None:
            self._work.close()
            self._work.deleteLater()
            self._work = None

    def _next(self) -> None:
        if self._work is not None or self._wanted is None:
            return
        self._work = _DwellReading(*self._wanted, self)
        self._work.done.connect(self._done)
        self._work.failed.connect(self._failed)
        self._work.start()

    def _done(self, samples: object) -> None:
        key = self._ended()
        if key == self._wanted:
            self._wanted = None
            self.read.emit(key[1], samples)
        self._next()

    def _failed(self, why: str) -> None:
        if self._ended() == self._wanted:
            self._wanted = None
            self.failed.emit(why)
        self._next()

    def _ended(self) -> tuple[Path, int]:
        work, self._work = self._work, None
        assert work is not None
        work.deleteLater()
        return work.path, work.step


class _DwellReading(BackgroundTask[DwellSamples]):
    def __init__(self, path: Path, step: int, parent: QObject) -> None:
        super().__init__(self._read, parent)
        self.path, self.step = path, step

    def _read(self, progress: Progress) -> DwellSamples:
        with SessionFile(self.path) as session:
            return dwell_of(session, self.step, lambda: progress(0.0))
