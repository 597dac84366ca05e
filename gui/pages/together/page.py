"""Several files of one core: chosen, fitted with one law, and what one law cannot explain."""

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QShowEvent
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QMenu,
    QSplitter,
    QTabWidget,
    QTextBrowser,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from gui.actions.controller import AppController
from gui.actions.taking_together import paths_of
from gui.page import Page
from gui.pages.diagnosis.finding import Finding
from gui.pages.together.chosen import ChosenFiles
from gui.pages.together.fit_plot import FitPlot
from gui.pages.together.fits import fitted_files, has_stages
from gui.pages.together.numbers import (
    candidate_rows,
    headline,
    left_rows,
    number_rows,
    owner_lines,
    owners,
)
from gui.pages.together.saving import Saving
from gui.pages.together.tables import CandidatesTable, LeftTable, NumbersTable
from gui.state import SessionState
from gui.widgets.basic import button, hint
from gui.widgets.mark import Mark
from gui.widgets.work_bar import WorkBar
from instrument.facts.diagnosis import DiagnosisResult, StageName
from instrument.facts.doubts import doubts_of
from instrument.facts.modal import ModalResult
from instrument.results.standing import fit_words, stage_before
from instrument.results.typeset import note

_NOTHING = (
    "Several files of one core follow one law: masses measured one after the other on the same pads, beams "
    "of several lengths, a plate in several files. Add them (Ctrl+Shift+O, or drop them here), or one alone, "
    "each with its specimen; one specimen serves all unless you choose others.\n\nIdentify gives the one law "
    "with its band. Diagnose says what one law cannot explain, and of which file that is."
)
_NOT_JUDGED = "Points are judged one by one where a diagnosis was made: it weighs each of them."
_NOTHING_LEFT = "Nothing: nothing is set aside, and no point is further than 3 standard deviations off."


class TogetherPage(Page):
    """Files, their fit, and what is found of them."""

    title = "Several files"
    hint = "Files of one core under one law: identified and diagnosed together"

    def __init__(self, controller: AppController) -> None:
        super().__init__(controller)
        self.together = controller.together
        self.chosen, self.finding, self.law = ChosenFiles(self.together), Finding(), QLabel()
        self.doubt = Mark()
        self.doubt.setWordWrap(True)
        self.fit, self.numbers, self.left, self.notes = FitPlot(), NumbersTable(), LeftTable(), QTextBrowser()
        self.candidates, self.stage = CandidatesTable(), QComboBox()
        self.identify = button("Identify", "One law of all files (Ctrl+I)", "material", primary=True)
        self.identify.setShortcut("Ctrl+I")
        self.diagnose = button(
            "Diagnose", "What one law cannot explain, and of which file (Ctrl+D)", "diagnosis"
        )
        self.diagnose.setShortcut("Ctrl+D")
        self.save = QToolButton()
        self.material = button("On Material", "The law with its band")
        self.diagnosis = button("On Diagnosis", "Candidates, residuals, the next measurement")
        self.working = WorkBar()
        self.saving = Saving(self.together, self)
        self.empty = hint(_NOTHING)
        self.setAcceptDrops(True)
        self._arrange()
        self._connect()
        self._show()

    def refresh(self, state: SessionState) -> None:
        """Nothing here is a session's."""

    def showEvent(self, event: QShowEvent) -> None:
        """What came while the page was not seen."""
        super().showEvent(event)
        self.together.look_again()
        self._show()

    def changeEvent(self, event: QEvent) -> None:
        """A file that was mended in another program is looked at again as a person comes back."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.ActivationChange and self.isVisible() and self.isActiveWindow():
            self.together.look_again()

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Files dropped here are fitted together instead of opened."""
        if paths_of(event.mimeData()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Add what was dropped; a specimen file goes to the file selected, or to all."""
        event.acceptProposedAction()
        self.chosen.take(paths_of(event.mimeData()))

    # What is shown

    def _show(self) -> None:
        if not self.isVisible():
            return
        found, shown = self.together.identified, self.together.diagnosed
        diagnosed = shown.found if shown is not None else None
        self.chosen.show_files(owners(diagnosed) if diagnosed is not None else {})
        self._show_controls()
        self.empty.setVisible(found is None)
        self.filler.setVisible(found is None)
        self.views.setVisible(found is not None)
        self.law.setVisible(found is not None)
        for one in (self.finding, self.candidates):
            one.setVisible(shown is not None)
        # The notice over the tabs goes away.
        failure = f"No result: {self.together.failure}" if self.together.failure else ""
        self.doubt.say(failure, "bad", bold=True)
        self.doubt.setVisible(bool(failure))
        if shown is not None:
            self.finding.show_diagnosis(shown)
            self.finding.show_followed(owner_lines(shown.found))
            self.candidates.show_candidates(candidate_rows(shown.found))
        if found is None:
            return
        self.law.setText(headline(found))
        doubts = doubts_of(found) if shown is None else ()
        said = " ".join(filter(None, (failure, *map(note, doubts))))
        self.doubt.say(said, "bad", bold=True)
        self.doubt.setVisible(bool(said))
        self._offer_stages(diagnosed)
        notes = list(dict.fromkeys((*found.warnings, *(diagnosed.warnings if diagnosed is not None else ()))))
        self.notes.setPlainText("\n\n".join(map(note, notes)) or "Nothing to note.")
        self.views.setTabText(self.views.indexOf(self.notes), f"Notes ({len(notes)})" if notes else "Notes")
        self._show_stage()

    def _show_stage(self) -> None:
        """The fit chosen: of the law alone, or with the effects found."""
        found, shown = self.together.identified, self.together.diagnosed
        if found is None:
            return
        diagnosed = shown.found if shown is not None else None
        stage: StageName = "after" if self.stage.currentData() == "after" else "before"
        judged = diagnosed is not None and has_stages(found)
        names = [one.data.name for one in self.together.files]
        fitted = fitted_files(found, diagnosed if judged else None, stage, names=names)
        self.fit.show_files(fitted, of_modes=isinstance(found, ModalResult))
        adjusted = found.adjusted
        if diagnosed is not None:
            adjusted = diagnosed.stage(stage).adjusted or (
                diagnosed.adjusted if stage == "after" else adjusted
            )
        self.numbers.show_numbers(number_rows(adjusted, found.files or ()))
        source = diagnosed if diagnosed is not None else found
        aside = () if isinstance(source, ModalResult) else source.set_aside or ()
        points = () if isinstance(source, ModalResult) else source.points_set_aside
        rows = left_rows(fitted, aside, points, judged=judged)
        self.left.show_left(rows)
        self.left_said.setText(_NOTHING_LEFT if judged else _NOT_JUDGED)
        self.left_said.setVisible(not judged or not rows)
        title = f"Unexplained ({len(rows)})" if rows else "Unexplained"
        self.views.setTabText(self.views.indexOf(self.left_view), title)

    def _offer_stages(self, diagnosed: DiagnosisResult | None) -> None:
        choices = {"the law alone": "before"}
        if diagnosed is not None and stage_before(diagnosed) is not None:
            choices[f"with {fit_words(diagnosed)}"] = "after"
        if [self.stage.itemText(k) for k in range(self.stage.count())] == list(choices):
            return
        self.stage.blockSignals(True)
        self.stage.clear()
        for text, name in choices.items():
            self.stage.addItem(text, name)
        # What was found last is what stands.
        self.stage.setCurrentIndex(len(choices) - 1)
        self.stage.blockSignals(False)

    def _show_controls(self) -> None:
        together, running = self.together, self.together.running
        able = not self.chosen.why_not and not running
        self.identify.setEnabled(able)
        self.diagnose.setEnabled(able)
        self.chosen.setEnabled(not running)
        self.working.setVisible(running)
        for other in (self.save, self.material, self.diagnosis):
            other.setVisible(together.identified is not None and not running)
        self.save_diagnosis.setEnabled(together.diagnosed is not None)
        self.diagnosis.setEnabled(together.diagnosed is not None)

    # What a person does

    def _look_at_material(self) -> None:
        self.together.lead()
        self.controller.page_wanted.emit("material")

    def _look_at_diagnosis(self) -> None:
        self.together.lead()
        self.controller.page_wanted.emit("diagnosis")

    def _changed(self) -> None:
        if self.together.running:
            self.working.begin(self.together.work)
        self._show()

    # Inside

    def _connect(self) -> None:
        together = self.together
        together.changed.connect(self._changed)
        self.chosen.looked_at.connect(self._show_controls)
        together.progressed.connect(self.working.tell)
        together.failed.connect(self.controller.refused)
        self.saving.done.connect(self.controller.said)
        self.saving.failed.connect(self.controller.refused)
        self.identify.clicked.connect(together.identify)
        self.diagnose.clicked.connect(together.diagnose)
        self.working.cancel.clicked.connect(together.cancel)
        self.material.clicked.connect(self._look_at_material)
        self.diagnosis.clicked.connect(self._look_at_diagnosis)
        self.stage.currentIndexChanged.connect(self._show_stage)

    def _arrange(self) -> None:
        self.law.setWordWrap(True)
        self.law.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._arrange_saving()
        actions, results = QHBoxLayout(), QHBoxLayout()
        for one in (self.identify, self.diagnose, self.working):
            actions.addWidget(one)
        for other in (self.material, self.diagnosis, self.save):
            results.addWidget(other)
        actions.addStretch(1)
        results.addStretch(1)
        self._arrange_views()
        left, self.filler = QWidget(), QWidget()
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.chosen, 1)
        column.addLayout(actions)
        column.addWidget(self.law)
        column.addWidget(self.doubt)
        column.addWidget(self.candidates, 1)
        column.addLayout(results)
        right = QWidget()
        views = QVBoxLayout(right)
        views.setContentsMargins(0, 0, 0, 0)
        views.addWidget(self.empty)
        views.addWidget(self.views, 1)
        views.addWidget(self.filler, 1)
        whole = QSplitter(Qt.Orientation.Horizontal)
        whole.addWidget(left)
        whole.addWidget(right)
        whole.setSizes([600, 750])
        whole.setStretchFactor(1, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 4)
        column.addWidget(self.finding)
        column.addWidget(whole, 1)

    def _arrange_saving(self) -> None:
        self.save.setText("Save")
        self.save.setToolTip("As JSON, as the commands write it: `card` and `compare` read it")
        self.save.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self.save)
        menu.addAction("Identification...").triggered.connect(self.saving.identification)
        self.save_diagnosis = menu.addAction("Diagnosis...")
        self.save_diagnosis.triggered.connect(self.saving.diagnosis)
        self.save.setMenu(menu)

    def _arrange_views(self) -> None:
        self.left_view, self.left_said = QWidget(), hint(_NOT_JUDGED)
        inside = QVBoxLayout(self.left_view)
        inside.setContentsMargins(4, 4, 4, 0)
        inside.addWidget(self.left, 1)
        inside.addWidget(self.left_said)
        self.views = QTabWidget()
        for view, name, tip in (
            (self.fit, "Fit", "What was measured of each file, and the one law's line there"),
            (self.numbers, "Numbers", "Stated numbers the data moved: common ones, and each file's own"),
            (
                self.left_view,
                "Unexplained",
                "Stretches set aside, and points further off than noise",
            ),
            (self.notes, "Notes", "What fit and diagnosis have to say of themselves"),
        ):
            self.views.setTabToolTip(self.views.addTab(view, name), tip)
        self.views.setCornerWidget(self.stage)
        self.stage.setToolTip("The fit that is shown: of the law alone, or with the effects found")
        self.stage.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
