"""What could be measured next, ranked."""

from PySide6.QtWidgets import QAbstractItemView, QVBoxLayout, QWidget

from fitting.structures import AnySpecimen
from gui.pages.run.structure_view import StructureView
from gui.widgets.basic import hint
from gui.widgets.tables import Cell, ReadTable
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.follow_up import FollowUp
from instrument.results.next_words import NEXT_COLUMNS, next_row, separated_words
from instrument.results.offer_sketch import offer_view

_TIPS = (
    "Best first: by the time until one explanation is left, with what would follow",
    "Rig time, and a person's where it needs hands",
    "Chance that one explanation holds 95 % afterwards",
    "Expected logarithm of the odds between the two it separates best; 3 are odds of twenty",
)
_SAID = (
    "Settles it: the chance that one explanation holds 95 % afterwards. Likelier by: of the two that it "
    "separates best, how many times as likely the true one is expected to be as the other."
)


_DRAWN_PX = 160


class NextTable(QWidget):
    """Best first; the first is the one that is advised. Below, where the first is made that says a place."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        columns = dict(zip(NEXT_COLUMNS, _TIPS, strict=True)) | {"separates": "Explanations it tells apart"}
        self.table = ReadTable(columns, wide=(0, len(columns) - 1))
        self.table.setWordWrap(True)
        # A row may be higher than the table.
        self.table.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        # Rows of several lines run into one another otherwise.
        self.table.setShowGrid(True)
        self.table.horizontalHeader().sectionResized.connect(lambda *_: self.table.resizeRowsToContents())
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addWidget(self.table, 1)
        self.specimen: AnySpecimen | None = None
        """What it is of, where that is known."""
        self.drawn = StructureView()
        self.drawn.setFixedHeight(_DRAWN_PX)
        column.addWidget(self.drawn)
        column.addWidget(hint(_SAID))

    def show_diagnosis(self, found: DiagnosisResult) -> None:
        """Its ranking."""
        self.table.show_rows([_cells(f) for f in found.next_measurements])
        self.table.resizeRowsToContents()
        view = offer_view(self.specimen, found.next_measurements) if self.specimen is not None else None
        self.drawn.show_views([view] if view is not None else [])
        self.drawn.setVisible(view is not None)


def _cells(offer: FollowUp) -> list[Cell]:
    todo, seconds, settles, odds = next_row(offer)
    return [
        Cell(todo, offer.why, left=True),
        Cell(seconds),
        Cell(settles, fill="data", share=float(offer.probability_resolved)),
        Cell(odds),
        Cell(separated_words(offer.between), separated_words(offer.between, len(offer.between)), left=True),
    ]
