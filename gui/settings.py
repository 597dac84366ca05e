"""What the window remembers from one time to the next."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, get_args

from PySide6.QtCore import QByteArray, QSettings

from gui.theme import Mode

if TYPE_CHECKING:
    from gui.window import Window

_MOST_RECENT = 10
_LAYOUT = 1
"""Raised when docks change: an older arrangement is not restored then."""


class Settings:
    """In the user's own configuration folder. What cannot be understood there counts as not there."""

    def __init__(self) -> None:
        self._kept = QSettings(QSettings.Format.IniFormat, QSettings.Scope.UserScope, "viscorig", "window")

    @property
    def mode(self) -> Mode:
        """Light, dark, or as the system has it."""
        kept = self._kept.value("mode", "system")
        return next((mode for mode in get_args(Mode) if mode == kept), "system")

    @property
    def scale(self) -> float:
        """Of type."""
        try:
            return min(2.0, max(0.5, float(str(self._kept.value("scale", 1.0)))))
        except ValueError:
            return 1.0

    @property
    def recent(self) -> list[Path]:
        """Sessions opened, newest first."""
        kept = self._kept.value("recent", [])
        names = [kept] if isinstance(kept, str) else kept if isinstance(kept, list) else []
        return [Path(str(name)) for name in names if name]

    def remember(self, session: Path) -> None:
        """A session was opened."""
        path = session.resolve()
        newest = [path, *(p for p in self.recent if p != path)][:_MOST_RECENT]
        self._kept.setValue("recent", [str(p) for p in newest])

    def keep(self, window: Window) -> None:
        """Of a window that closes."""
        self._kept.setValue("geometry", window.saveGeometry())
        self._kept.setValue("docks", window.saveState(_LAYOUT))
        self._kept.setValue("page", window.tabs.currentIndex())
        self._kept.setValue("mode", window.appearance.mode)
        self._kept.setValue("scale", window.appearance.scale)
        self._kept.sync()

    def restore(self, window: Window) -> None:
        """To a new window."""
        geometry, docks = self._kept.value("geometry"), self._kept.value("docks")
        if isinstance(geometry, QByteArray):
            window.restoreGeometry(geometry)
        if isinstance(docks, QByteArray):
            window.restoreState(docks, _LAYOUT)
        page = str(self._kept.value("page", "0"))
        window.show_page(int(page) if page.isdecimal() else 0)
