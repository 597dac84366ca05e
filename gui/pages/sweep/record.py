"""The record of the point looked at, always beside the plots."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from gui.pages.sweep.record_lines import RecordLine, record_lines
from gui.pages.sweep.seen import PaneContents
from gui.widgets.basic import hint, tool
from gui.widgets.tables import Cell, ReadTable
from instrument.stepped_sine.settings import SweepSettings

_NONE = (
    "Click a point in any plot, or walk along with the left and right arrow keys: its record appears here."
)
_COLUMNS = {"Quantity": "Of the point looked at", "Value": "With its unit; Ctrl+C copies the whole record"}


class RecordPane(QWidget):
    """The record of one measured point, a line a quantity.

    Signals
    -------
    stepped : int
        The next point (1) or the one before (-1) is wanted.
    """

    stepped = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self.title, self.none = QLabel(), hint(_NONE)
        self.table = ReadTable(_COLUMNS)
        self.table.setAlternatingRowColors(True)
        self.table.horizontalHeader().hide()
        self.back = tool("left", "The point before (left arrow)")
        self.on = tool("right", "The next point (right arrow)")
        self.back.clicked.connect(self._back)
        self.on.clicked.connect(self._on)
        self._lines: list[RecordLine] = []
        above = QHBoxLayout()
        for widget, stretch in ((self.title, 1), (self.back, 0), (self.on, 0)):
            above.addWidget(widget, stretch)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(above)
        column.addWidget(self.none)
        column.addWidget(self.table, 1)
        column.addStretch(0)

    @property
    def lines(self) -> list[RecordLine]:
        """The lines that are shown."""
        return self._lines

    def show_seen(self, seen: PaneContents, settings: SweepSettings) -> None:
        """Draw."""
        at = seen.chosen
        lines = record_lines(seen, at, settings) if at is not None else []
        self.none.setVisible(at is None)
        self.table.setVisible(at is not None)
        for button in (self.back, self.on):
            button.setEnabled(bool(seen.wanted.any()))
        if lines == self._lines:
            return
        self._lines = lines
        self.title.setText(f"<b>{seen.points.frequency_hz[at]:.6g} Hz</b>" if at is not None else "")
        scrolled = self.table.verticalScrollBar().value()
        self.table.show_rows(
            [
                (
                    Cell(x.name, x.tip, faint=True, left=True),
                    Cell(x.value, f"{x.value}\n{x.tip}".strip(), left=True),
                )
                for x in lines
            ]
        )
        self.table.verticalScrollBar().setValue(scrolled)

    def _back(self) -> None:
        self.stepped.emit(-1)

    def _on(self) -> None:
        self.stepped.emit(1)
