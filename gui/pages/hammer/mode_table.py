"""The damping table: what three methods say of each mode."""

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from gui.pages.hammer.mode_words import MODE_COLUMNS, ModeRow
from gui.pages.hammer.table import ChoiceTable
from gui.style.theme import Role, current_theme
from gui.widgets.basic import button, hint

_USUAL = 8
"""Modes in the band."""


class ModeTable(QWidget):
    """Rows of modes, and a line that says where they are from.

    Signals
    -------
    selected
        Another mode, or none: `frequency_hz` says which.
    as_recorded
        The hits are to count as recorded again.
    """

    selected = Signal()
    as_recorded = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.source = QLabel()
        self.source.setWordWrap(True)
        self.source.setTextFormat(Qt.TextFormat.PlainText)
        self.back = button("As recorded", "Take every hit as it is recorded again")
        self.back.clicked.connect(self.as_recorded)
        self.back.hide()
        self.whole = button("Whole band", "Show the whole band again instead of one mode (W)", "whole")
        self.whole.setShortcut("W")
        self.whole.clicked.connect(self.deselect)
        self.note = hint("")
        self.table = ChoiceTable(MODE_COLUMNS, usual_rows=_USUAL)
        self.table.chosen.connect(self._reselected)
        self._rows: list[ModeRow] = []
        self._told: float | None = None
        self._role: Role = "text"
        self._arrange()

    def say(self, text: str, *, what_if: bool) -> None:
        """Where the rows are from."""
        self.source.setText(text)
        self.back.setVisible(what_if)
        self._role = "fair" if what_if else "text"
        self._tint()

    def show_rows(self, rows: list[ModeRow], advice: str) -> None:
        """All modes, and what the whole test teaches; the selection stays."""
        self._rows = rows
        self.note.setText(advice)
        self.note.setVisible(bool(advice))
        self.table.show_rows([row.cells for row in rows])
        self._reselected()

    def changeEvent(self, event: QEvent) -> None:
        """Colours follow the window's."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.ApplicationPaletteChange and hasattr(self, "_role"):
            self._tint()

    def select(self, number: int) -> None:
        """A mode, from 0."""
        self.table.selectRow(number)

    def deselect(self) -> None:
        """No mode: the whole band."""
        self.table.clearSelection()

    @property
    def frequency_hz(self) -> float | None:
        """Of the selected mode; None where none is."""
        row = self.table.selected
        return self._rows[row].frequency_hz if row is not None and row < len(self._rows) else None

    def _arrange(self) -> None:
        row = QHBoxLayout()
        row.addWidget(self.source, 1)
        row.addWidget(self.back)
        row.addWidget(self.whole)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(row)
        column.addWidget(self.table, 1)
        column.addWidget(self.note)

    def _reselected(self) -> None:
        self.whole.setEnabled(self.frequency_hz is not None)
        if self.frequency_hz != self._told:
            self._told = self.frequency_hz
            self.selected.emit()

    def _tint(self) -> None:
        color = current_theme().color(self._role)
        palette = self.source.palette()
        if palette.color(QPalette.ColorRole.WindowText) != color:
            palette.setColor(QPalette.ColorRole.WindowText, color)
            self.source.setPalette(palette)
