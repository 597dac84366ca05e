"""A table with one row chosen, which stays chosen when the rows are shown anew."""

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Signal

from gui.widgets.tables import ReadTable, Row


class ChoiceTable(ReadTable):
    """High enough for `usual_rows`; the last column takes what room there is.

    Signals
    -------
    chosen
        Another row, or none.
    """

    chosen = Signal()

    def __init__(self, columns: dict[str, str], *, usual_rows: int) -> None:
        super().__init__(columns, selects=True)
        self._usual_rows = usual_rows
        self.setAlternatingRowColors(True)
        self.setTabKeyNavigation(False)
        self.selectionModel().selectionChanged.connect(self.chosen)

    def show_rows(self, rows: Sequence[Row], columns: dict[str, str] | None = None) -> None:
        """Instead of those there were; the same place is chosen, where it still is one."""
        kept = self.selected
        with QSignalBlocker(self):
            super().show_rows(rows, columns)
            if kept is not None and kept < len(rows):
                self.selectRow(kept)
        if kept is not None and self.selected is None:
            self.chosen.emit()

    def sizeHint(self) -> QSize:
        """As high as the usual rows are, with a scroll bar below them."""
        rows = self._usual_rows * self.verticalHeader().defaultSectionSize()
        rows += self.horizontalScrollBar().sizeHint().height()
        high = self.horizontalHeader().sizeHint().height() + rows + 2 * self.frameWidth()
        return QSize(super().sizeHint().width(), high)
