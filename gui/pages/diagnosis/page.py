"""What the model lacks: verdict, evidence, residual, and a person's word on it."""

from dataclasses import replace
from functools import partial
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QShowEvent
from PySide6.QtWidgets import (
    QMenu,
    QSplitter,
    QTabWidget,
    QTextBrowser,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from gui.actions.controller import AppController
from gui.actions.rediagnosis import DiagnosisAsked, ShownDiagnosis
from gui.files.short_name import short_name
from gui.page import Page
from gui.pages.diagnosis.candidates import Candidates
from gui.pages.diagnosis.comparison import HeldOutBars, LawChange
from gui.pages.diagnosis.finding import Finding
from gui.pages.diagnosis.next_table import NextTable
from gui.pages.diagnosis.residual_plots import ResidualPlots
from gui.pages.diagnosis.unseen_table import UnseenTable
from gui.state import SessionState
from gui.widgets.asking import ask_open
from gui.widgets.basic import button, hint
from gui.widgets.work_bar import WorkBar
from instrument.facts.diagnosis import DiagnosisResult
from instrument.results.diagnosis_words import set_aside_words
from instrument.results.followed import followed_lines, followed_of
from instrument.results.typeset import typeset

_HERE = (
    "Here will be what the model of the specimen lacks: the residual of the best law, the effects that "
    "may explain it, ranked by evidence, and what each does to the material."
)
_OTHERS = "Diagnose other data"
_WHAT_TO_DO = (
    "Open a session (Ctrl+O) or run an experiment; or drop a sweep of another program (.csv, .uff, .mat) "
    "and diagnose it here."
)


class DiagnosisPage(Page):
    """The page that shows what the model lacks."""

    title = "Diagnosis"
    hint = "What the model lacks: residual, candidates, before and after"

    def __init__(self, controller: AppController) -> None:
        super().__init__(controller)
        self.finding, self.candidates = Finding(), Candidates()
        self.residual, self.held_out, self.law = ResidualPlots(), HeldOutBars(), LawChange()
        self.next, self.unseen = NextTable(), UnseenTable()
        self.story = QTextBrowser()
        self.empty = hint(_HERE)
        self.diagnose = button(
            "Diagnose this session", "Try every effect of the catalogue on all its points", "diagnosis"
        )
        self.others = QToolButton()
        self.back = button("Back to the recorded one", "Let go of what was computed here")
        self.working = WorkBar()
        self._shown: ShownDiagnosis | None = None
        self._specimen_folder = ""
        self._found_of: dict[QWidget, DiagnosisResult] = {}
        self._arrange()
        self._connect()

    def refresh(self, state: SessionState) -> None:
        """Draw what has changed."""
        if self.news("diagnosis", "run"):
            self._show()

    def clear(self) -> None:
        """There is no session any more."""
        self._show()

    def showEvent(self, event: QShowEvent) -> None:
        """What came while the page was not seen."""
        super().showEvent(event)
        self._show()

    # What is shown

    def _show(self) -> None:
        if not self.isVisible():
            return
        rediagnosis = self.controller.rediagnosis
        shown = rediagnosis.shown(self.controller.state)
        self._show_controls(shown)
        state = self.controller.state
        own = state.contents.following if state is not None and shown is not None else []
        asked = shown is not None and shown.asked is not None
        self.finding.show_followed(followed_lines(followed_of([] if asked else own)))
        before, self._shown = self._shown, shown
        if shown is None:
            heading, text = self._why_nothing()
            self.finding.show_none(heading)
            self.empty.setText(text)
        elif before is None or shown.found is not before.found:
            self.finding.show_diagnosis(shown)
            self.candidates.show_candidates(rediagnosis.ranking(self.controller.state) or shown.found)
            self.story.setPlainText("\n".join(_story(shown)))
            of_session = state is not None and (shown.asked is None or shown.asked.of_session)
            self.next.specimen = state.contents.specimen if state is not None and of_session else None
            self.views.setTabVisible(self.views.indexOf(self.next), bool(shown.found.next_measurements))
            self.views.setTabVisible(self.views.indexOf(self.unseen), bool(shown.found.unseen))
            self._show_view()

    def _show_view(self) -> None:
        """The one that is seen; the others when they are."""
        if self._shown is None:
            return
        for view in (self.residual, self.held_out, self.law, self.next, self.unseen):
            seen = view is self.views.currentWidget()
            if seen and self._found_of.get(view) is not self._shown.found:
                self._found_of[view] = self._shown.found
                view.show_diagnosis(self._shown.found)

    def _show_controls(self, shown: ShownDiagnosis | None) -> None:
        running, session = self.controller.rediagnosis.running, self.controller.session
        self.body.setVisible(shown is not None)
        self.empty.setVisible(shown is None)
        self.filler.setVisible(shown is None)
        self.diagnose.setVisible(shown is None and session is not None and not running)
        self.others.setVisible(bool(self._foreign) and not running)
        self.back.setVisible(self.controller.rediagnosis.found is not None and not running)
        own = self.controller.state is not None and self.controller.state.contents.diagnosis is not None
        self.back.setText("Back to the recorded one" if own else "Let go of this diagnosis")
        self.working.setVisible(running)
        able = session is not None or (shown is not None and shown.asked is not None)
        self.candidates.allow(able and not running, "" if able else "The session is still being measured")

    def _why_nothing(self) -> tuple[str, str]:
        """In large, and what there will be."""
        state = self.controller.state
        if state is None and (foreign := self._foreign):
            named = short_name(foreign[0].name) if len(foreign) == 1 else f"{len(foreign)} files"
            then = f"Next: {_OTHERS}, on the right; its specimen is asked for."
            return f"No diagnosis of {named} yet", f"{_HERE}\n\n{then}"
        if state is None:
            return "No diagnosis", f"{_HERE}\n\n{_WHAT_TO_DO}"
        if state.run.state == "diagnosing":
            return "Tracing what the fit cannot explain ...", _HERE
        if not state.run.over:
            return "No diagnosis yet: it is made when the sweep is whole", _HERE
        found = state.contents.diagnosis
        if found is not None:
            return f"No diagnosis was possible: {found.message}", _HERE
        if state.run.state == "stopped":
            return "The run was stopped before a diagnosis was made", _HERE
        return "This session holds no diagnosis", _HERE

    # What a person does

    def _diagnose_session(self) -> None:
        if self.controller.session is not None:
            self.controller.rediagnosis.start(DiagnosisAsked(self.controller.session))

    def _diagnose_other(self) -> None:
        action = self.sender()
        assert isinstance(action, QAction)
        data = Path(str(action.data()))
        start = self._specimen_folder or str(data.parent)
        then = partial(self._diagnose_with, data)
        ask_open(self, f"Specimen of {data.name}", start, "Specimen (*.toml)", then)

    def _diagnose_with(self, data: Path, specimen: Path) -> None:
        self._specimen_folder = str(specimen.parent)
        self.candidates.clear()
        self.controller.rediagnosis.start(DiagnosisAsked(data, specimen))

    def _recompute(self) -> None:
        decisions = self.candidates.decisions
        asked = self._shown.asked if self._shown is not None else None
        if asked is None:
            if self.controller.session is None:
                return
            asked = DiagnosisAsked(self.controller.session)
        declined = () if decisions.accept_argument is not None else decisions.declined
        asked = replace(asked, accept=decisions.accept_argument, decline=declined)
        self.controller.rediagnosis.start(asked)

    def _go_back(self) -> None:
        self.candidates.clear()
        self.controller.rediagnosis.forget()

    def _changed(self) -> None:
        if self.controller.rediagnosis.running:
            self.working.begin("starting")
        self._show()

    def _another_session(self) -> None:
        self.candidates.clear()
        self._show()

    def _offer_others(self) -> None:
        menu = self.others.menu()
        assert menu is not None
        menu.clear()
        for path in self._foreign:
            action = menu.addAction(f"{short_name(path.name)}...")
            action.setData(str(path))
            action.triggered.connect(self._diagnose_other)
        self._show()

    # Inside

    @property
    def _foreign(self) -> list[Path]:
        return [path for path, found in self.controller.beside.items() if found.sweeps]

    def _connect(self) -> None:
        rediagnosis = self.controller.rediagnosis
        self.views.currentChanged.connect(self._show_view)
        rediagnosis.changed.connect(self._changed)
        rediagnosis.progressed.connect(self.working.tell)
        rediagnosis.failed.connect(self.controller.refused)
        self.controller.changed.connect(self._another_session)
        self.controller.beside_changed.connect(self._offer_others)
        self.diagnose.clicked.connect(self._diagnose_session)
        self.back.clicked.connect(self._go_back)
        self.working.cancel.clicked.connect(rediagnosis.cancel)
        self.candidates.recompute.connect(self._recompute)

    def _arrange(self) -> None:
        self.others.setText(_OTHERS)
        self.others.setToolTip("A sweep laid beside the session; its specimen is asked for")
        self.others.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.others.setMenu(QMenu(self.others))
        self.filler = QWidget()
        for one in (self.diagnose, self.others, self.back, self.working):
            self.finding.corner.addWidget(one)
        self.views = QTabWidget()
        for view, name, tip in (
            (self.residual, "Residual", "What the fit leaves of every point, before and after"),
            (self.held_out, "Error", "On data held out, and on all: before, after, noise alone"),
            (self.law, "Law", "What the effects do to the material"),
            (self.next, "Next", "What would tell the explanations apart, ranked"),
            (self.unseen, "Unseen", "What may be there without being named, and what it would do to the law"),
        ):
            self.views.setTabToolTip(self.views.addTab(view, name), tip)
        left = QSplitter(Qt.Orientation.Vertical)
        left.addWidget(self.candidates)
        left.addWidget(self.story)
        left.setStretchFactor(0, 3)
        left.setStretchFactor(1, 1)
        left.setSizes([260, 110])
        self.body = QSplitter(Qt.Orientation.Horizontal)
        self.body.addWidget(left)
        self.body.addWidget(self.views)
        self.body.setSizes([620, 740])
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 4)
        column.addWidget(self.finding)
        column.addWidget(self.empty)
        column.addWidget(self.body, 1)
        column.addWidget(self.filler, 1)


def _story(shown: ShownDiagnosis) -> list[str]:
    """The explanation, what was set aside, what is to be noted."""
    found = shown.found
    said = list(found.explanation)
    if found.set_aside_hz:
        said.append(set_aside_words(found))
    return [typeset(text) for text in (*said, *(f"Note: {text}." for text in found.warnings))]
