"""The list of hits and what can be said of the selected one."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from gui.pages.hammer.table import ChoiceTable
from gui.pages.hammer.words import HIT_COLUMNS, HitRow
from gui.widgets.basic import button

_USUAL = 7
"""Hits of a test."""


class HitList(QWidget):
    """Shows rows; what is to be done with a hit is up to whoever listens.

    Signals
    -------
    selected
        Another hit, or none: `number` says which.
    accepted, rejected, undone
        The operator's word about the hit of this number.
    content
        The hits there are may be used.
    """

    selected = Signal()
    accepted = Signal(int)
    rejected = Signal(int)
    undone = Signal(int)
    content = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._rows: list[HitRow] = []
        self._undoable: frozenset[int] = frozenset()
        self.prompt = QLabel()
        self.prompt.setWordWrap(True)
        self.prompt.setTextFormat(Qt.TextFormat.PlainText)
        self.table = ChoiceTable(HIT_COLUMNS, usual_rows=_USUAL)
        self.table.chosen.connect(self._reselected)
        self.accept = button("Accept", "Use this hit, whatever its verdict (A)", "check")
        self.reject = button("Reject", "Leave this hit out of the average (R)", "close")
        self.undo = button("Undo", "Back to the verdict before the operator's word (U)", "undo")
        for one, key in ((self.accept, "A"), (self.reject, "R"), (self.undo, "U")):
            one.setShortcut(key)
            one.setEnabled(False)
        self.accept.clicked.connect(self._accept)
        self.reject.clicked.connect(self._reject)
        self.undo.clicked.connect(self._undo)
        self.plates = QComboBox()
        self.plates.addItems(["bare plate", "damped plate"])
        self.plates.setToolTip("Whose hits are shown")
        self.plates.hide()
        self.use = button("Use these hits", "End the hammer test with the hits marked used")
        self.use.clicked.connect(self.content)
        font = self.use.font()
        font.setBold(True)
        self.use.setFont(font)
        self.use.hide()
        self._arrange()

    @property
    def number(self) -> int:
        """Of the selected hit; 0 where none is."""
        row = self.table.selected
        return self._rows[row].number if row is not None and row < len(self._rows) else 0

    def show_rows(self, rows: list[HitRow], undoable: frozenset[int]) -> None:
        """All hits. The selection stays; it moves on to a new hit where it was on the last one."""
        was_last = self.number == (self._rows[-1].number if self._rows else 0)
        grown = len(rows) != len(self._rows)
        self._rows, self._undoable = rows, undoable
        self.table.show_rows([row.cells for row in rows])
        if grown and was_last and rows:
            self.table.selectRow(len(rows) - 1)
        self._enable()

    def select(self, number: int) -> None:
        """A hit by its number."""
        for k, row in enumerate(self._rows):
            if row.number == number:
                self.table.selectRow(k)

    def _enable(self) -> None:
        row = next((r for r in self._rows if r.number == self.number), None)
        self.accept.setEnabled(row is not None and not row.used)
        self.reject.setEnabled(row is not None and row.used)
        self.undo.setEnabled(self.number in self._undoable)

    def _arrange(self) -> None:
        row = QHBoxLayout()
        for one in (self.accept, self.reject, self.undo):
            row.addWidget(one)
        row.addStretch(1)
        row.addWidget(self.plates)
        row.addWidget(self.use)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.prompt)
        column.addWidget(self.table, 1)
        column.addLayout(row)

    def _reselected(self) -> None:
        self._enable()
        self.selected.emit()

    def _accept(self) -> None:
        self.accepted.emit(self.number)

    def _reject(self) -> None:
        self.rejected.emit(self.number)

    def _undo(self) -> None:
        self.undone.emit(self.number)
