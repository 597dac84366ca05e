"""The law found: G'(f) and eta(f) with their bands as they converge, in numbers, beside other laws."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSplitter, QTabWidget, QTextBrowser, QVBoxLayout

from gui.controller import AppController
from gui.mark import Mark
from gui.page import Page
from gui.pages.law.curve import LawCurve, joined, resonances_hz
from gui.pages.law.plots import LawLine, LawPlots
from gui.pages.material.comparison import LawComparison
from gui.pages.material.numbers import headline, parameters, places
from gui.pages.material.tables import Correlations, Parameters, Places
from gui.rediagnosis import ShownDiagnosis
from gui.state import SessionState
from instrument.facts.identification import IdentificationResult
from instrument.results.diagnosis_words import UNKNOWN
from instrument.stream.derived import FitUpdated

_NOTHING = (
    "Here will be the core's law: storage modulus G'(f) and loss factor η(f) with their bands, from the "
    "first segment on. Open a session (Ctrl+O), run an experiment, or add laws to compare on the right."
)
_NO_FIT = "No fit yet: the first follows the first segment."
_NEVER = "This session holds no fit."


class MaterialPage(Page):
    """Storage modulus and loss factor with their bands."""

    title = "Material"
    hint = "Storage modulus and loss factor with their bands, parameters, comparison"

    def __init__(self, controller: AppController) -> None:
        super().__init__(controller)
        self.said, self.origin = QLabel(_NOTHING), Mark()
        self.plots, self.comparison = LawPlots(), LawComparison()
        self.places, self.parameters, self.correlations = Places(), Parameters(), Correlations()
        self.notes = QTextBrowser()
        self._curves: dict[int, LawCurve] = {}
        self._late = True
        self._arrange()
        self.comparison.changed.connect(self._draw_lines)
        self.comparison.failed.connect(controller.refused)
        controller.comparison_wanted.connect(self.comparison.read)
        controller.changed.connect(self._another_session)
        controller.rediagnosis.changed.connect(self._show)

    def refresh(self, state: SessionState) -> None:
        """Draw what has changed."""
        if self.news("fits", "diagnosis"):
            self._show()
        self.said.setText(self._headline(state))

    def clear(self) -> None:
        """There is no session any more."""
        self._show()

    def showEvent(self, event: QShowEvent) -> None:
        """What came while the page was not seen."""
        super().showEvent(event)
        if self._late:
            self._show()

    def _another_session(self) -> None:
        self._curves.clear()
        self._show()

    def _show(self) -> None:
        self._late = not self.isVisible()
        if self._late:
            return
        state = self.controller.state
        self.said.setText(self._headline(state))
        self._draw_lines()
        fit, shown = self._latest, self._diagnosed
        after = shown.found.after if shown is not None else None
        fitted = self._curve(fit) if fit is not None else None
        result = fit.result if fit is not None else None
        rows = places(result, fitted, LawCurve.of(after.law) if after is not None else None)
        self.places.show_places(rows, with_effects=after is not None)
        start = state.contents.specimen.core if state is not None else None
        law = start.law if start is not None else None
        self.parameters.show_parameters(
            parameters(result, law, after) if result is not None else [], with_effects=after is not None
        )
        self.correlations.show_fit(result)
        self._show_notes(result, shown)

    def _draw_lines(self) -> None:
        fits = self._fits
        lines = []
        if len(fits) > 1:
            earlier = joined([self._curve(fit) for fit in fits[:-1]])
            lines.append(LawLine(f"earlier fits ({len(fits) - 1})", earlier, "faint", width=1.0))
        if fits:
            name = f"identified ({UNKNOWN})" if self._is_unknown else "identified"
            lines.append(LawLine(name, self._curve(fits[-1]), "model"))
        lines += _diagnosed_lines(self._diagnosed) + self.comparison.lines
        self.plots.show_lines(lines, self._resonances)

    def _show_notes(self, result: IdentificationResult | None, shown: ShownDiagnosis | None) -> None:
        notes = list(result.warnings) if result is not None else []
        if shown is not None:
            notes += shown.found.warnings
        if self._is_unknown:
            notes.insert(
                0, f"{UNKNOWN}: nothing explains what the fit leaves, the law may be far off its band"
            )
        self.notes.setPlainText("\n\n".join(f"{n[0].upper()}{n[1:]}." for n in notes) or "Nothing to note.")
        self.tabs.setTabText(self.tabs.indexOf(self.notes), f"Notes ({len(notes)})" if notes else "Notes")
        made_here = shown is not None and shown.asked is not None
        self.origin.say(f"● diagnosis {shown.origin}" if shown and made_here else "", "fair", bold=True)

    def _headline(self, state: SessionState | None) -> str:
        if state is None:
            return _NOTHING if self._diagnosed is None else ""
        empty = _NEVER if state.run.over else _NO_FIT
        return headline(state.fits, state.fit_running) or empty

    @property
    def _fits(self) -> list[FitUpdated]:
        """Those that gave a law."""
        state = self.controller.state
        return [fit for fit in state.fits if fit.result is not None] if state is not None else []

    @property
    def _latest(self) -> FitUpdated | None:
        fits = self._fits
        return fits[-1] if fits else None

    @property
    def _diagnosed(self) -> ShownDiagnosis | None:
        """The diagnosis shown, where an effect is accepted."""
        shown = self.controller.rediagnosis.shown(self.controller.state)
        return shown if shown is not None and shown.found.equivalent else None

    @property
    def _is_unknown(self) -> bool:
        """Whether the diagnosis shown found no explanation."""
        shown = self.controller.rediagnosis.shown(self.controller.state)
        return shown is not None and shown.found.verdict == "unknown"

    @property
    def _resonances(self) -> list[float]:
        latest = self._latest
        points = latest.result.points if latest is not None and latest.result is not None else ()
        return list(resonances_hz(points).values())

    def _curve(self, fit: FitUpdated) -> LawCurve:
        if fit.number not in self._curves:
            self._curves[fit.number] = LawCurve.of(fit.result.law if fit.result is not None else ())
        return self._curves[fit.number]

    def _arrange(self) -> None:
        self.said.setWordWrap(True)
        self.tabs = QTabWidget()
        for view, name, tip in (
            (
                self.parameters,
                "Parameters",
                "Of the law, with uncertainty, limits reached, what is not fixed",
            ),
            (self.correlations, "Correlations", "Between the parameters"),
            (self.notes, "Notes", "What the fit has to say of itself"),
            (self.comparison, "Other laws", "The paper's law and other sessions beside this one"),
        ):
            self.tabs.setTabToolTip(self.tabs.addTab(view, name), tip)
        right = QSplitter(Qt.Orientation.Vertical)
        right.addWidget(self.places)
        right.addWidget(self.tabs)
        right.setSizes([180, 220])
        whole = QSplitter(Qt.Orientation.Horizontal)
        whole.addWidget(self.plots)
        whole.addWidget(right)
        whole.setSizes([735, 620])
        whole.setStretchFactor(0, 3)
        whole.setStretchFactor(1, 2)
        above = QHBoxLayout()
        above.addWidget(self.said, 1)
        above.addWidget(self.origin)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 4)
        column.addLayout(above)
        column.addWidget(whole, 1)


def _diagnosed_lines(shown: ShownDiagnosis | None) -> list[LawLine]:
    """Before and after the effects accepted."""
    if shown is None:
        return []
    by_hand = ", by hand" if shown.asked is not None and shown.asked.by_hand else ""
    before, after = (LawCurve.of(stage.law) for stage in shown.found.stages)
    effects = " and ".join(shown.found.equivalent)
    return [
        LawLine("diagnosis: without effect", before, "model", dashed=True, width=1.5),
        LawLine(f"diagnosis: with {effects}{by_hand}", after, "data"),
    ]
