"""What the window remembers from one time to the next."""

from dataclasses import dataclass
from pathlib import Path
from typing import get_args

from PySide6.QtCore import QByteArray, QSettings

from gui.style.theme import Appearance, Mode
from instrument.files.acceleration import USUAL

_MOST_RECENT = 10
_MOST_PAIRS = 100
"""Of data and specimens: a laboratory's last weeks."""


@dataclass(frozen=True)
class Arrangement:
    """Where a window was and what it showed; None or empty where nothing is known."""

    geometry: QByteArray | None
    docks: QByteArray | None
    page: str
    """Its name."""


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
        """Factor on the size of type."""
        try:
            return min(2.0, max(0.5, float(str(self._kept.value("scale", 1.0)))))
        except ValueError:
            return 1.0

    @property
    def acceleration(self) -> str:
        """Unit in which accelerations are shown, by its name in `instrument.files.acceleration`."""
        return str(self._kept.value("acceleration", USUAL))

    @acceleration.setter
    def acceleration(self, name: str) -> None:
        self._kept.setValue("acceleration", name)

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

    @property
    def specimens(self) -> dict[Path, Path]:
        """Of data that were fitted together, the specimens they had; the newest first."""
        kept = self._kept.value("specimens", [])
        names = kept if isinstance(kept, list) else []
        if len(names) % 2:
            return {}
        return {
            Path(str(data)): Path(str(specimen)) for data, specimen in zip(*[iter(names)] * 2, strict=True)
        }

    def remember_specimen(self, data: Path, specimen: Path) -> None:
        """One was chosen for these data."""
        newest = {data: specimen} | {d: s for d, s in self.specimens.items() if d != data}
        self._kept.setValue(
            "specimens", [str(p) for pair in list(newest.items())[:_MOST_PAIRS] for p in pair]
        )

    def keep(self, arrangement: Arrangement, appearance: Appearance) -> None:
        """Of a window that closes."""
        self._kept.setValue("geometry", arrangement.geometry)
        self._kept.setValue("docks", arrangement.docks)
        self._kept.setValue("page", arrangement.page)
        self._kept.setValue("mode", appearance.mode)
        self._kept.setValue("scale", appearance.scale)
        self._kept.sync()

    @property
    def arrangement(self) -> Arrangement:
        """For a new window."""
        geometry, docks = self._kept.value("geometry"), self._kept.value("docks")
        return Arrangement(
            geometry if isinstance(geometry, QByteArray) else None,
            docks if isinstance(docks, QByteArray) else None,
            str(self._kept.value("page", "")),
        )
