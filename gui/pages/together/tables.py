"""Numbers that the fit moved, and what it leaves, as tables."""

from collections.abc import Sequence

from gui.pages.together.numbers import CandidateRow, LeftRow, NumberRow
from gui.widgets.tables import Cell, ReadTable

_NUMBERS = {
    "number": "What was stated of specimen and channels",
    "file": "Whose it is: common to all, or one file's own",
    "stated": "± its tolerance",
    "found": "± one standard error",
    "pull": "How far the data moved it, in tolerances",
}
_LEFT = {
    "file": "Whose",
    "f / Hz": "Frequency",
    "what": "Why it counts as not explained",
    "off / %": "Fitted over measured, less one; of a stretch its largest",
}
_CANDIDATES = {
    "explanation": "What was fitted together with the law, best first",
    "of file": "All files alike, each its own, or one alone",
    "probability": "Of this explanation, one of those that were tried being right",
}
_MOST_PULL = 3.0
"""Beyond it the number is marked, as the commands warn of it."""


class NumbersTable(ReadTable):
    """Common numbers first, then each kind file by file."""

    def __init__(self) -> None:
        super().__init__(_NUMBERS)

    def show_numbers(self, rows: Sequence[NumberRow]) -> None:
        """Instead of those there were."""
        self.show_rows([_number(row) for row in rows])


class CandidatesTable(ReadTable):
    """The explanations that were tried, for a glance."""

    def __init__(self) -> None:
        super().__init__(_CANDIDATES, wide=(1,))

    def show_candidates(self, rows: Sequence[CandidateRow]) -> None:
        """Best first."""
        self.show_rows([_candidate(row) for row in rows])


class LeftTable(ReadTable):
    """Stretches and points that nothing explains."""

    def __init__(self) -> None:
        super().__init__(_LEFT, wide=(2,))

    def show_left(self, rows: Sequence[LeftRow]) -> None:
        """Instead of those there were."""
        self.show_rows(
            [
                [Cell(r.file, left=True), Cell(r.where), Cell(r.what, left=True), Cell(r.off_percent)]
                for r in rows
            ]
        )


def _number(row: NumberRow) -> list[Cell]:
    share = min(abs(row.pull) / _MOST_PULL, 1.0)
    beyond = abs(row.pull) > _MOST_PULL
    return [
        Cell(row.name, left=True, bold=beyond),
        Cell(row.file, left=True, faint=row.file == "all"),
        Cell(row.stated),
        Cell(row.found, bold=beyond),
        Cell(f"{row.pull:+.2f}", fill="fair" if beyond else "data", share=share, bold=beyond),
    ]


def _candidate(row: CandidateRow) -> list[Cell]:
    named = row.standing in ("found", "equal")
    return [
        Cell(row.name, left=True, bold=named, edge="data" if named else None),
        Cell(row.file, left=True),
        Cell(row.probability, bold=named),
    ]
