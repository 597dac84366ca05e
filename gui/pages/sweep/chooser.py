"""The list of segments: how each stands, and which one the plots show."""

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QWidget

from gui.pages.sweep.segments import SegmentStatus
from gui.style.theme import Role, current_theme

_COLORS: dict[str, Role] = {"planned": "faint", "running": "data", "broken off": "bad", "done": "text"}


class Chooser(QListWidget):
    """All of them first.

    Signals
    -------
    chosen
        `segment` is another one.
    """

    chosen = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.segment: int | None = None
        self._standings: list[SegmentStatus] = []
        self.setAlternatingRowColors(True)
        self.setToolTip("Segments of the sweep: choose the one the plots show (up and down arrow)")
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWordWrap(True)
        self.currentRowChanged.connect(self._row_changed)
        self.show_standings([])

    def show_standings(self, standings: list[SegmentStatus]) -> None:
        """Draw; the segment chosen stays chosen while it is there."""
        if standings == self._standings and self.count():
            return
        self._standings = standings
        with QSignalBlocker(self):
            while self.count() > len(standings) + 1:
                self.takeItem(self.count() - 1)
            while self.count() <= len(standings):
                self.addItem(QListWidgetItem())
            self.item(0).setText(_summary(standings))
            for row, standing in enumerate(standings, start=1):
                self.item(row).setText(standing.lines)
                self.item(row).setData(Qt.ItemDataRole.UserRole, standing.number)
            self._color()
            numbers = [s.number for s in standings]
            self.setCurrentRow(numbers.index(self.segment) + 1 if self.segment in numbers else 0)
        self._row_changed(self.currentRow())

    def changeEvent(self, event: QEvent) -> None:
        """Rows follow the colours of the window."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_standings"):
            self._color()

    def choose(self, segment: int | None) -> None:
        """As if it were clicked."""
        for row, standing in enumerate(self._standings, start=1):
            if standing.number == segment:
                self.setCurrentRow(row)
                return
        self.setCurrentRow(0)

    def _color(self) -> None:
        theme = current_theme()
        for row, standing in enumerate(self._standings, start=1):
            self.item(row).setForeground(theme.color(_COLORS[standing.state]))

    def _row_changed(self, row: int) -> None:
        segment = self.item(row).data(Qt.ItemDataRole.UserRole) if row > 0 else None
        if segment != self.segment:
            self.segment = segment
            self.chosen.emit()


def _summary(standings: list[SegmentStatus]) -> str:
    done = sum(s.state == "done" for s in standings)
    return f"All segments\n{done} of {len(standings)} done" if standings else "All segments\nnone planned"
