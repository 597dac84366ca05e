"""Word of files that are written while their forms are open, whoever writes them."""

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QFileSystemWatcher, QObject, Signal


class DiskWatch(QObject):
    """Says only that it is worth looking; a file's stamp says what is so.

    Signals
    -------
    touched
        A file, or something in its folder, was written.
    """

    touched = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._watcher = QFileSystemWatcher(self)
        self._watcher.fileChanged.connect(self.touched)
        self._watcher.directoryChanged.connect(self.touched)

    def follow(self, files: Sequence[Path]) -> None:
        """These alone, and their folders: many programs put a new file in the place of the old one."""
        wanted = {str(path) for file in files for path in (file, file.parent) if path.exists()}
        followed = {*self._watcher.files(), *self._watcher.directories()}
        if followed - wanted:
            self._watcher.removePaths(sorted(followed - wanted))
        if wanted - followed:
            self._watcher.addPaths(sorted(wanted - followed))
