"""The fit's numbers on the screen."""

from math import isfinite

from PySide6.QtWidgets import QVBoxLayout, QWidget

from gui.actions.together import Fitted
from gui.pages.law.curve import At
from gui.pages.material.numbers import STRONG, Parameter, Place, correlation_rows, labelled
from gui.style.theme import Role
from gui.widgets.basic import hint
from gui.widgets.tables import Cell, ReadTable
from instrument.results.numbers import with_error

_PLACES = {
    "f / Hz": "20, 100, 280 Hz and the resonances, as far as they were measured",
    "at": "Resonance: where the response measured in a segment is largest",
    "G' / MPa": "Storage modulus: after the diagnosis where there is one, ± one standard error",
    "η": "Loss factor: after the diagnosis where there is one, ± one standard error",
}
_PLACES_BEFORE = {
    "G' before / MPa": "Storage modulus before the diagnosis: without the effects it found",
    "η before": "Loss factor before the diagnosis: without the effects it found",
}
_PARAMETERS = {
    "parameter": "Of the law",
    "value": "± one standard error, by noise",
    "error / %": "Standard error over value",
    "remark": "Limits reached, and what the data do not fix",
}
_BEFORE = {"before": "Before the diagnosis: without the effects it found"}
_HEAT = 0.75
_CORRELATIONS_SAID = (
    "Correlations of the logarithms of the parameters. Near ±1 the data fix a combination of two, not each: "
    "rely on G'(f) and η(f) inside the measured band."
)


class Places(ReadTable):
    """The law at some frequencies."""

    def __init__(self) -> None:
        super().__init__(_PLACES)

    def show_places(self, rows: list[Place], *, with_before: bool) -> None:
        """The law that stands, and that before the diagnosis where effects were found."""
        wanted = _PLACES | (_PLACES_BEFORE if with_before else {})
        self.show_rows([_place(row, with_before) for row in rows], wanted)


class Parameters(ReadTable):
    """The table of a law's parameters."""

    def __init__(self) -> None:
        super().__init__(_PARAMETERS)

    def show_parameters(self, rows: list[Parameter], *, with_before: bool) -> None:
        """Of the law that stands, and of that before the diagnosis where effects were found."""
        wanted = _PARAMETERS | (_BEFORE if with_before else {})
        self.show_rows([_parameter(row, with_before) for row in rows], wanted)


class Correlations(QWidget):
    """The matrix as a heat map with its numbers."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.table = ReadTable({}, fills=False)
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 4, 0)
        column.addWidget(self.table, 1)
        column.addWidget(hint(_CORRELATIONS_SAID))

    def show_fit(self, fit: Fitted | None) -> None:
        """Its correlations; none without a fit."""
        names, matrix = correlation_rows(fit) if fit is not None else ([], [])
        short = [labelled(name)[0].split(" / ")[0] for name in names]
        self.table.show_rows(
            [
                [Cell(name, bold=True, left=True), *(_heat(c, f"{name} and {other}") for c, other in pairs)]
                for name, row in zip(short, matrix, strict=True)
                for pairs in [list(zip(row, short, strict=True))]
            ],
            {"": "", **dict(zip(short, names, strict=True))},
        )


def _heat(c: float, names: str) -> Cell:
    if not isfinite(c):
        return Cell("–", f"{names}: none, one sits at its limit", faint=True)
    role: Role = "data" if c >= 0 else "model"
    return Cell(f"{c:+.3f}", f"{names}: {c:+.5f}", bold=abs(c) > STRONG, fill=role, alpha=_HEAT * abs(c))


def _place(row: Place, with_before: bool) -> list[Cell]:
    cells = [
        Cell(f"{row.frequency_hz:.4g}", bold=not row.where),
        Cell(row.where, left=True, faint=True),
        *_pair(row.law),
    ]
    return [*cells, *_pair(row.before, faint=True)] if with_before else cells


def _pair(at: At | None, *, faint: bool = False) -> list[Cell]:
    if at is None:
        return [Cell("–"), Cell("–")]
    pairs = ((at.storage_mpa, at.storage_error_mpa), (at.loss, at.loss_error))
    return [Cell(with_error(value, error), faint=faint) for value, error in pairs]


def _parameter(row: Parameter, with_before: bool) -> list[Cell]:
    cells = [
        Cell(row.label, row.key, bold=True, left=True),
        Cell(row.value),
        Cell(row.percent),
        Cell(row.remark, left=True, fill="fair" if row.remark else None, alpha=0.25),
    ]
    return [*cells, Cell(row.before, faint=True)] if with_before else cells
