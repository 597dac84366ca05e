"""The candidates ranked, and a person's word on them."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from fitting.diagnosis.verdict.kin import UNLISTED
from gui.pages.diagnosis.ranking import (
    WORDS,
    CandidateRow,
    Decisions,
    RowStanding,
    about,
    group_words,
    ranked,
)
from gui.style.theme import Role
from gui.widgets.basic import button
from gui.widgets.tables import Cell, ReadTable
from instrument.facts.diagnosis import DiagnosisResult

_COLUMNS = {
    "effect": "Missing effect that was fitted together with the law",
    "standing": "Found: accepted by the data. Not told from it: fits as well, within the data's power. "
    "Or your word: accepted effects are fitted, declined ones left out of the search",
    "probability": "Of this explanation, one of those that were tried being right: prior times marginal "
    "likelihood. The bar is the evidence: how many times as likely as no effect, in powers of e (3 is 20 "
    "times).",
    "chi²/degree": "What is left, in units of noise and model error: 1 where nothing is",
    "parameters ± standard error": "Of the effect, as fitted with the law",
}
_ROLES: dict[RowStanding, Role] = {
    "found": "data",
    "equal": "model",
    "none": "faint",
    "other": "grid",
    "not fitted": "faint",
}


class Candidates(QWidget):
    """Ranked, the likeliest first.

    Signals
    -------
    recompute
        A person wants what `decisions` say.
    """

    recompute = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.decisions = Decisions()
        self.table = ReadTable(_COLUMNS, selects=True)
        self.groups = QLabel()
        self.groups.setWordWrap(True)
        self.accept = button(
            "Accept", "Fit the selected effect with the law; again to take it back (double click)"
        )
        self.decline = button("Decline", "Leave the selected effect out of the search; again to take it back")
        self.compute = button("Recompute", "")
        self.what_to_do = QLabel("Select an effect to accept or decline it.")
        self.what_to_do.setEnabled(False)
        self.what_to_do.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._rows: list[CandidateRow] = []
        self._arrange()
        self.accept.clicked.connect(self._accept)
        self.decline.clicked.connect(self._decline)
        self.compute.clicked.connect(self.recompute)
        self.table.doubleClicked.connect(self._accept)
        self.table.selectionModel().selectionChanged.connect(self._show_buttons)
        self._able = False
        self._show_buttons()

    def show_candidates(self, found: DiagnosisResult) -> None:
        """Of a whole search; the words on them stay."""
        chosen = self._chosen
        self._rows = ranked(found)
        self.groups.setText(group_words(found))
        self.groups.setVisible(bool(self.groups.text()))
        self._show_rows(chosen)

    def allow(self, able: bool, why_not: str = "") -> None:
        """Whether something can be computed now."""
        self._able = able
        for one in (self.accept, self.decline):
            one.setVisible(able)
        self.compute.setToolTip(why_not)
        self._show_buttons()

    def clear(self) -> None:
        """Nothing is decided about anything."""
        self.decisions.clear()
        self._show_rows()

    @property
    def _chosen(self) -> str:
        row = self.table.selected
        return self._rows[row].name if row is not None else ""

    def _accept(self) -> None:
        if self._chosen and self._able:
            self.decisions.accept(self._chosen)
            self._decided()

    def _decline(self) -> None:
        if self._chosen:
            self.decisions.decline(self._chosen)
            self._decided()

    def _decided(self) -> None:
        self._show_rows(self._chosen)

    def _show_buttons(self) -> None:
        chosen = self._chosen
        self.what_to_do.setVisible(self._able and not chosen and not self.decisions.any)
        self.accept.setEnabled(bool(chosen) and chosen != UNLISTED)
        self.decline.setEnabled(bool(chosen) and chosen not in ("none", UNLISTED))
        self.compute.setEnabled(self._able and self.decisions.any)
        self.compute.setText(f"Recompute: {self.decisions.words}" if self.decisions.any else "Recompute")

    def _show_rows(self, chosen: str = "") -> None:
        best = max((row.gain or 0.0 for row in self._rows), default=0.0)
        self.table.show_rows([self._cells(row, best) for row in self._rows])
        names = [row.name for row in self._rows]
        if chosen in names:
            self.table.selectRow(names.index(chosen))
        self._show_buttons()

    def _cells(self, row: CandidateRow, best: float) -> list[Cell]:
        role, faint = _ROLES[row.standing], row.standing == "not fitted"
        marked = row.standing in ("found", "equal")
        parameters = ", ".join(row.parameters)
        gain = row.gain or 0.0
        share = max(gain, 0.0) / best if best > 0 else 0.0
        return [
            Cell(
                row.name, about(row.name), bold=marked, faint=faint, edge=role if marked else None, left=True
            ),
            self._standing_cell(row),
            Cell(row.probability, row.gain_words, faint=faint, fill=role, share=share),
            Cell("–" if row.chi2_per_dof is None else f"{row.chi2_per_dof:.3g}", faint=faint),
            Cell(parameters or "–", "\n".join(row.parameters), faint=faint, left=True),
        ]

    def _standing_cell(self, row: CandidateRow) -> Cell:
        decided = self.decisions.of(row.name)
        if decided:
            role: Role = "good" if decided == "accepted" else "bad"
            return Cell(f"{decided} by hand", bold=True, left=True, fill=role, alpha=0.25)
        return Cell(WORDS[row.standing], faint=row.standing == "not fitted", left=True)

    def _arrange(self) -> None:
        buttons = QHBoxLayout()
        for one in (self.accept, self.decline, self.compute, self.what_to_do):
            buttons.addWidget(one, 100 * (one is self.what_to_do))
        self.what_to_do.setWordWrap(True)
        buttons.addStretch(1)
        self.groups.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.table, 1)
        column.addWidget(self.groups)
        column.addLayout(buttons)
