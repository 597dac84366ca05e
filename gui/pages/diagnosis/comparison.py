"""What the effects found change: the error on data held out, and the law."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QSplitter, QVBoxLayout, QWidget

from gui.pages.diagnosis.stages import ComparedMeasure, compared, lacking, laws, references_hz
from gui.pages.law.curve import At
from gui.pages.law.plots import LawLine, LawPlots
from gui.style.theme import Role
from gui.widgets.tables import Cell, ReadTable
from instrument.facts.diagnosis import DiagnosisResult
from instrument.results.diagnosis_words import UNRELIABLE, with_verdict
from instrument.results.numbers import format_number, with_error
from instrument.results.standing import law_words, one_fit_words, stage_before
from instrument.results.typeset import capitalised

_ERRORS = {
    "what the fit leaves": "Held-out data: a segment predicted by law and effects fitted to the others",
    "": "Unit",
    "before": "Without any effect",
    "after": "With the effects accepted",
    "noise alone": "What a perfect model would leave",
}
_LAW = {
    "f / Hz": "Frequency",
    "G' / MPa before": "Storage modulus without any effect, ± one standard error",
    "G' / MPa after": "Storage modulus with the effects accepted, ± one standard error",
    "change": "After over before, less one",
    "η before": "Loss factor without any effect, ± one standard error",
    "η after": "Loss factor with the effects accepted, ± one standard error",
    "change ": "After over before, less one",
}
_ONE_LAW = {
    "f / Hz": "Frequency",
    "G' / MPa": "Storage modulus, ± one standard error",
    "η": "Loss factor, ± one standard error",
    "": "",
}
_BARS = "Bars of percent share one scale; noise alone is what a perfect model would leave."


class HeldOutBars(QWidget):
    """Errors in numbers and bars; bars of one unit share their scale."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.table = ReadTable(_ERRORS, wide=(2, 3, 4))
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addWidget(self.table, 1)
        self.said = QLabel(_BARS)
        self.said.setWordWrap(True)
        self.said.setEnabled(False)
        column.addWidget(self.said)

    def show_diagnosis(self, found: DiagnosisResult) -> None:
        """Before and after."""
        rows, after = compared(found), stage_before(found) is not None
        percents = [
            v
            for r in rows
            if r.unit == "% rms"
            for v in (r.before, r.after if after else None, r.noise)
            if v is not None
        ]
        said = [_BARS, *([] if after else [_one_fit(found)]), *(f"{capitalised(w)}." for w in lacking(found))]
        self.said.setText(" ".join(said))
        cells = [_error_cells(row, max(percents, default=1.0)) for row in rows]
        self.table.show_rows(cells if after else [[*r[:3], Cell("-"), r[4]] for r in cells])


class LawChange(QWidget):
    """G' and eta before and after, drawn and in numbers."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.plots, self.table = LawPlots(), ReadTable(_LAW)
        self.doubt = QLabel()
        self.doubt.setWordWrap(True)
        split = QSplitter(Qt.Orientation.Vertical)
        split.addWidget(self.plots)
        split.addWidget(self.table)
        split.setStretchFactor(0, 3)
        split.setStretchFactor(1, 1)
        split.setSizes([300, 110])
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addWidget(self.doubt)
        column.addWidget(split, 1)

    def show_diagnosis(self, found: DiagnosisResult) -> None:
        """Before and after."""
        before, after = laws(found)
        changed = stage_before(found) is not None
        said = [] if changed else [_one_fit(found)]
        if found.verdict == "unknown":
            said.insert(0, f"{capitalised(UNRELIABLE)}.")
        self.doubt.setText(" ".join(said))
        self.doubt.setVisible(bool(said))
        lines = [LawLine(with_verdict("law", found), after, "model")]
        if changed:
            lines = [
                LawLine(with_verdict("before", found), before, "model", dashed=True),
                LawLine(with_verdict(f"after: with {law_words(found)}", found), after, "data"),
            ]
        self.plots.show_lines(lines)
        rows = []
        for f in references_hz(found):
            b, a = before.at(f), after.at(f)
            assert b is not None
            assert a is not None
            rows.append(_law_cells(f, b, a) if changed else _one_law_cells(f, a))
        self.table.show_rows(rows, _LAW if changed else _ONE_LAW)


def _one_fit(found: DiagnosisResult) -> str:
    return f"{capitalised(one_fit_words(found))}: there is one fit and one law."


def _error_cells(row: ComparedMeasure, scale: float) -> list[Cell]:
    values: tuple[tuple[float | None, Role], ...] = (
        (row.before, "model"),
        (row.after, "data"),
        (row.noise, "faint"),
    )
    barred = row.unit == "% rms" and scale > 0
    return [
        Cell(row.what, bold=row.held_out, left=True),
        Cell(row.unit, left=True, faint=True),
        *(
            Cell(
                format_number(v, 3), fill=role if barred and v is not None else None, share=(v or 0.0) / scale
            )
            for v, role in values
        ),
    ]


def _one_law_cells(f: float, b: At) -> list[Cell]:
    return [
        Cell(f"{f:.4g}"),
        Cell(with_error(b.storage_mpa, b.storage_error_mpa), bold=True),
        Cell(with_error(b.loss, b.loss_error), bold=True),
    ]


def _law_cells(f: float, b: At, a: At) -> list[Cell]:
    return [
        Cell(f"{f:.4g}"),
        Cell(with_error(b.storage_mpa, b.storage_error_mpa)),
        Cell(with_error(a.storage_mpa, a.storage_error_mpa), bold=True),
        Cell(f"{100 * (a.storage_mpa / b.storage_mpa - 1):+.2f} %"),
        Cell(with_error(b.loss, b.loss_error)),
        Cell(with_error(a.loss, a.loss_error), bold=True),
        Cell(f"{100 * (a.loss / b.loss - 1):+.2f} %"),
    ]
