"""What may be there without being named."""

from PySide6.QtWidgets import QVBoxLayout, QWidget

from gui.tables import Cell, ReadTable
from instrument.facts.diagnosis import DiagnosisResult, UnseenEffect
from instrument.results.unseen_words import UNSEEN_COLUMNS, unseen_row

_TIPS = (
    "Law and stated numbers would imitate it: nothing shows",
    "The largest size that would not be seen, no larger than where a laboratory usually has it",
    "That a laboratory's set-up has it at all, before any data",
    "By how much it would shift G', where in the band it shifts it most",
    "The same of the loss factor",
    "The larger of both, in standard errors of the law's band: it covers two",
)


class UnseenTable(QWidget):
    """What would shift the law most first."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.table = ReadTable(dict(zip(UNSEEN_COLUMNS, _TIPS, strict=True)), wide=(0, 1))
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addWidget(self.table)

    def show_diagnosis(self, found: DiagnosisResult) -> None:
        """Its list."""
        self.table.show_rows([_cells(one) for one in found.unseen])


def _cells(one: UnseenEffect) -> list[Cell]:
    name, size, *shifts = unseen_row(one)
    return [Cell(name, left=True), Cell(size, left=True), *(Cell(shift) for shift in shifts)]
