"""The law found: G'(f) and eta(f) with their bands as they converge, in numbers, beside other laws."""

from typing import overload

from PySide6.QtCore import Qt
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSplitter, QTabWidget, QTextBrowser, QVBoxLayout

from gui.actions.controller import AppController
from gui.actions.rediagnosis import ShownDiagnosis
from gui.actions.together import Fitted
from gui.page import Page
from gui.pages.law.curve import LawCurve, joined, resonances_hz
from gui.pages.law.plots import LawLine, LawPlots
from gui.pages.material.comparison import LawComparison
from gui.pages.material.numbers import failure_words, headline, parameters, places
from gui.pages.material.tables import Correlations, Parameters, Places
from gui.pages.together.numbers import count_of
from gui.pages.together.numbers import headline as headline_together
from gui.state import SessionState
from gui.widgets.mark import Mark
from instrument.facts.diagnosis import StageFitted
from instrument.facts.doubts import doubts_of
from instrument.facts.identification import IdentificationResult
from instrument.facts.session_result import SessionResult
from instrument.results.diagnosis_words import DOUBTED, UNKNOWN, UNRELIABLE
from instrument.results.session_result import (
    BEFORE_DIAGNOSIS,
    Conditions,
    recorded_result,
    result_of,
)
from instrument.results.standing import law_words, stage_before
from instrument.results.typeset import note, typeset
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
        self.said, self.origin, self.doubt = QLabel(_NOTHING), Mark(), Mark(large=True)
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
        controller.together.changed.connect(self._show)

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
        result, shown = self._fitted, self._shown
        # Nothing is before a diagnosis that accepted no effect: its law is that one.
        before = stage_before(shown.found) if shown is not None else None
        stands = shown.found.after if shown is not None else result
        resonances = self._resonances
        rows = places(_curve(stands), resonances, _curve(before)) if stands is not None else []
        self.places.show_places(rows, with_before=before is not None)
        start = state.contents.specimen.core if state is not None and self._is_of_session else None
        law = start.law if start is not None else None
        correlations = result.correlations if result is not None and shown is None else {}
        self.parameters.show_parameters(
            parameters(stands, law, correlations, before) if stands is not None else [],
            with_before=before is not None,
        )
        self.correlations.show_fit(result)
        self.tabs.setTabText(
            self.tabs.indexOf(self.correlations),
            "Correlations" + (f", {BEFORE_DIAGNOSIS}" if before is not None else ""),
        )
        self._show_notes(result, shown)

    def _draw_lines(self) -> None:
        fits, lines = self._fits, []
        if len(fits) > 1:
            earlier = joined([self._curve(fit) for fit in fits[:-1]])
            lines.append(LawLine(f"earlier fits ({len(fits) - 1})", earlier, "faint", width=1.0))
        shown = self._shown
        if shown is not None:
            lines += diagnosed_lines(shown)
        elif self._together is not None:
            name = f"identified, {count_of(self._together)}{self._in_doubt}"
            lines.append(LawLine(name, LawCurve.of(self._together.law), "model"))
        elif fits:
            lines.append(LawLine(f"identified{self._in_doubt}", self._curve(fits[-1]), "model"))
        lines += self.comparison.lines
        self.plots.show_lines(lines, list(self._resonances.values()))

    def _show_notes(self, result: Fitted | None, shown: ShownDiagnosis | None) -> None:
        notes = notes_of(result, shown)
        if self._is_unknown:
            notes.insert(
                0, f"{UNKNOWN}: nothing explains what the fit leaves, the law may be far off its band"
            )
        self.notes.setPlainText("\n\n".join(map(note, notes)) or "Nothing to note.")
        self.tabs.setTabText(self.tabs.indexOf(self.notes), f"Notes ({len(notes)})" if notes else "Notes")
        doubts = [UNRELIABLE] if self._is_unknown else self._doubts
        self.doubt.say(" ".join(map(note, doubts)), "bad", bold=True)
        self.doubt.setVisible(bool(doubts))
        made_here = shown is not None and shown.asked is not None
        said = f"● diagnosis {shown.origin}" if shown and made_here else ""
        if self._together is not None and shown is None:
            said = f"● identified here of {count_of(self._together)}, not recorded"
        self.origin.say(said, "fair", bold=True)

    def _headline(self, state: SessionState | None) -> str:
        said = self._said_of_law(state)
        if state is None or state.fit_failed is None or not self._is_of_session:
            return said
        failed = failure_words(state.fit_failed, sweeping=state.run.state == "sweep")
        return f"{said}; {failed}" if self._fits or self._shown is not None else failed

    def _said_of_law(self, state: SessionState | None) -> str:
        shown = self._shown
        if shown is not None:
            return _in_words(result_of(None, shown.found, _conditions(state, shown)))
        if self._together is not None:
            return headline_together(self._together)
        if state is None:
            return _NOTHING
        if state.run.over and state.fit_running is None and state.contents.fit is not None:
            return _in_words(recorded_result(state.contents))
        empty = _NEVER if state.run.over else _NO_FIT
        return headline(state.fits, state.fit_running) or empty

    @property
    def _doubts(self) -> tuple[str, ...]:
        """What the law that stands says against itself."""
        shown, result = self._shown, self._fitted
        if shown is not None:
            return doubts_of(shown.found)
        return doubts_of(result) if result is not None else ()

    @property
    def _in_doubt(self) -> str:
        return f" ({DOUBTED})" if self._doubts else ""

    @property
    def _is_of_session(self) -> bool:
        """Whether what is shown is of the session that is open, and not of other data."""
        shown = self._shown
        return self._together is None and (shown is None or shown.asked is None or shown.asked.of_session)

    @property
    def _fits(self) -> list[FitUpdated]:
        """The session's that gave a law; none where what is shown is of other data."""
        state = self.controller.state
        if state is None or not self._is_of_session:
            return []
        return [fit for fit in state.fits if fit.result is not None]

    @property
    def _latest(self) -> FitUpdated | None:
        fits = self._fits
        return fits[-1] if fits else None

    @property
    def _together(self) -> Fitted | None:
        """The fit of several files that is shown in place of the session's."""
        return self.controller.together.shown

    @property
    def _fitted(self) -> Fitted | None:
        """The fit that is shown: of several files, or the session's latest."""
        if self._together is not None:
            return self._together
        return self._latest.result if self._latest is not None else None

    @property
    def _shown(self) -> ShownDiagnosis | None:
        """The diagnosis whose law stands: the recorded one, or one made here; of several files theirs."""
        if self._together is not None:
            return self.controller.together.diagnosed
        return self.controller.rediagnosis.shown(self.controller.state)

    @property
    def _is_unknown(self) -> bool:
        """Whether the diagnosis shown found no explanation."""
        shown = self._shown
        return shown is not None and shown.found.verdict == "unknown"

    @property
    def _resonances(self) -> dict[int, float]:
        """Of a session; several files have their peaks at many places."""
        result = self._fitted
        if self._together is not None or not isinstance(result, IdentificationResult):
            return {}
        return resonances_hz(result.points)

    def _curve(self, fit: FitUpdated) -> LawCurve:
        if fit.number not in self._curves:
            self._curves[fit.number] = LawCurve.of(fit.result.law if fit.result is not None else ())
        return self._curves[fit.number]

    def _arrange(self) -> None:
        for label in (self.said, self.doubt):
            label.setWordWrap(True)
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
        column.addWidget(self.doubt)
        column.addLayout(above)
        column.addWidget(whole, 1)


def notes_of(result: Fitted | None, shown: ShownDiagnosis | None) -> list[str]:
    """What a fit and a diagnosis have to say of themselves, each once."""
    notes = list(result.warnings) if result is not None else []
    if shown is None:
        return notes
    notes = [said for said in notes if said not in shown.found.warnings]
    if stage_before(shown.found) is not None:
        notes = [f"{BEFORE_DIAGNOSIS}: {said}" for said in notes]
    return [*notes, *shown.found.warnings]


def diagnosed_lines(shown: ShownDiagnosis) -> list[LawLine]:
    """The law that stands, and before it that without the effects accepted."""
    if stage_before(shown.found) is None:
        return [LawLine(shown.in_legend("result"), _curve(shown.found.after), "model")]
    return [
        LawLine(BEFORE_DIAGNOSIS, _curve(shown.found.before), "model", dashed=True, width=1.5),
        LawLine(shown.in_legend(f"result: with {law_words(shown.found)}"), _curve(shown.found.after), "data"),
    ]


def _conditions(state: SessionState | None, shown: ShownDiagnosis) -> Conditions:
    """The session's; another file's by its points."""
    if state is not None and (shown.asked is None or shown.asked.of_session):
        return Conditions.of_points(state.contents.measured)
    return Conditions.of_diagnosis(shown.found)


def _in_words(result: SessionResult) -> str:
    return typeset(result.words)


@overload
def _curve(found: StageFitted | Fitted) -> LawCurve: ...
@overload
def _curve(found: None) -> None: ...
def _curve(found: StageFitted | Fitted | None) -> LawCurve | None:
    return LawCurve.of(found.law) if found is not None else None
