"""What may be there without being named."""

from PySide6.QtWidgets import QVBoxLayout, QWidget

from gui.widgets.basic import hint
from gui.widgets.tables import Cell, ReadTable
from instrument.facts.diagnosis import DiagnosisResult, UnseenEffect
from instrument.results.typeset import heading, typeset
from instrument.results.unseen_words import UNSEEN_COLUMNS, unseen_row

_TIPS = (
    "Law and stated numbers would imitate it: nothing shows",
    "The largest size that would not be seen, no larger than where a laboratory usually has it",
    "That a laboratory's set-up has it at all, before any data",
    "By how much it would shift G', where in the band it shifts it most",
    "The same of the loss factor",
    "The larger of both, in standard errors of the law's band: it covers two",
)
_COLUMNS = tuple(heading(name).replace("loss factor", "η") for name in UNSEEN_COLUMNS)
"""With the sign that the window's other tables have: there is no room for the word."""
_SAID = (
    "Not found, but up to this size it would not be seen if it were there: law and stated numbers imitate "
    "it, and the law would be off by as much as stands here."
)


class UnseenTable(QWidget):
    """What would shift the law most first."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.table = ReadTable(dict(zip(_COLUMNS, _TIPS, strict=True)))
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addWidget(self.table, 1)
        column.addWidget(hint(_SAID))

    def show_diagnosis(self, found: DiagnosisResult) -> None:
        """Its list."""
        self.table.show_rows([_cells(one) for one in found.unseen])


def _cells(one: UnseenEffect) -> list[Cell]:
    name, size, *shifts = unseen_row(one)
    return [Cell(name, left=True), Cell(typeset(size), left=True), *(Cell(shift) for shift in shifts)]
