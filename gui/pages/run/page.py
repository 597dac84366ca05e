"""The page of the experiment and its run: files on the left, what is run and how it stands on the right."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Literal

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QMenu, QSplitter, QTabWidget, QVBoxLayout, QWidget

from fitting.specimen import PlateSpecimen
from gui.actions.controller import AppController
from gui.actions.export import Export
from gui.background.task import BackgroundTask, Progress
from gui.form.fields import Place
from gui.page import Page
from gui.pages.run.banner import Banner
from gui.pages.run.check import Check, CheckPane
from gui.pages.run.files_panel import FilesPanel
from gui.pages.run.now import NowPane
from gui.pages.run.start_panel import StartPanel
from gui.pages.run.structure_view import Drawing
from gui.state import SessionState
from gui.widgets.basic import button
from instrument.engine.messages import Ended, OperatorAsked
from instrument.facts.check import CheckResult
from instrument.session.configuration import Configuration

_FORMATS = (("csv", "CSV..."), ("uff", "Universal file..."), ("mat", "MATLAB..."))


class RunPage(Page):
    """Choose and edit an experiment, check it, run it, watch it, keep what it gave."""

    title = "Run"
    hint = "Choose an experiment, check it, run it"

    def __init__(self, controller: AppController) -> None:
        super().__init__(controller)
        self.files, self.starting = FilesPanel(), StartPanel()
        self.banner, self.now = Banner(), NowPane(controller)
        self.check, self.checked, self.drawing = Check(self), CheckPane(), Drawing()
        self.plate = self.drawing.plate
        self.export = Export(controller, self)
        self.report_button = button("Report...", "One self-contained page of the session", "report")
        self.export_button = button("Export", "The session's data for other programs", "export")
        self._asked: OperatorAsked | None = None
        self._next: Literal["", "check", "start"] = ""
        self._check_again = False
        """Once the files are read again: there was a dry run of them, or one was asked for."""
        self._forecast: CheckResult | None = None
        """Of the experiment as it is on the disk; None where it is not known."""
        self._read: Path | None = None
        """The experiment that was read last."""
        self._looked_into = False
        """Whether a dry run of these files was asked for, whatever it says."""
        self._looking: BackgroundTask[list[Path]] | None = None
        self._drawn_of: Configuration | None = None
        """Of the session whose specimen is drawn; None where it is that of the forms."""
        self._arrange()
        self._connect()
        self._show_what_may_be_done()

    # From the window

    def refresh(self, state: SessionState) -> None:
        """Draw what has changed."""
        # What has been asked for once is no news any more.
        runs, points = self.news("run"), self.news("points")
        if self.news("step", "samples", "log") or runs:
            self.now.show_state(state, self.controller.live, self._ending)
        if runs or points:
            self.now.show_segments(state)
        if self.files.drafts is None and self._drawn_of is not state.configuration:
            self._drawn_of = state.configuration
            self.drawing.show_specimen(state.configuration.the_specimen())
        self._show_question(state)

    def clear(self) -> None:
        """There is no session any more."""
        self.now.clear()
        self.banner.ask("")
        self._drawn_of = None
        if self.files.drafts is None:
            self.drawing.show_drafts(None)

    @property
    def unsaved(self) -> bool:
        """The experiment, or a file that it names."""
        return self.files.changed

    def before_lost(self, then: Callable[[], object]) -> None:
        """Save, discard or neither."""
        self.files.before_lost(then)

    # What a person does

    def _check(self) -> None:
        self._save_then("check")

    def _start(self) -> None:
        self._save_then("start")

    def _save_then(self, what: Literal["check", "start"]) -> None:
        self._next = what
        self.files.look()
        if self.files.changed and not self.files.changed_elsewhere:
            self.files.save()
        else:
            self._go_on()

    def _go_on(self) -> None:
        """The files are on the disk, as the forms show them or as another program has them."""
        what, self._next, path = self._next, "", self.files.path
        if path is None or not what:
            return
        if self.files.changed_elsewhere:
            # What would begin is not what the forms show.
            self._check_again = True
            self.controller.refused.emit(f"nothing is begun: {self.files.outdated_said}")
            return
        if what == "start":
            self.controller.start(self.starting.order(path))
        self._look_into(path)

    def _look_into(self, path: Path) -> None:
        """A dry run, unless there was one of these files."""
        self._looked_into = True
        if self._forecast is None:
            self.checked.wait()
            self.check.start(path)
        if not self.controller.starting:
            self.tabs.setCurrentWidget(self.checked)

    # What follows

    def _opened(self) -> None:
        self._forget_check()
        self.drawing.show_drafts(self.files.drafts)
        self.starting.show_experiment(self.files.drafts)
        path = self.files.path
        again, self._read = path is not None and path == self._read, path
        if path is not None:
            if not again:
                self.starting.propose(path.parent)
            self._look_for_broken_off()
        self._show_what_may_be_done()
        check, self._check_again = self._check_again, False
        if path is not None and again and check:
            self._look_into(path)

    def _outdated(self) -> None:
        """What was checked is not what is on the disk."""
        self._check_again |= self._looked_into
        self._forget_check()

    def _mark_moved(self, file: str, place: Place, text: str) -> None:
        if not self.controller.running:
            self.files.forms[file].type_into(place, text)

    def _edited(self) -> None:
        self._forget_check()
        self.drawing.show_drafts(self.files.drafts)
        self.starting.show_experiment(self.files.drafts)

    def _saved(self) -> None:
        self._forget_check()
        self.starting.show_experiment(self.files.drafts)
        self._go_on()

    def _failed(self, message: str) -> None:
        self._next = ""
        self.controller.refused.emit(message)

    def _forget_check(self) -> None:
        self._forecast, self._looked_into = None, False
        self.check.cancel()
        self.checked.clear()

    def _passed(self, found: CheckResult) -> None:
        self._forecast = found
        self.checked.show_result(found)

    def _objected(self, lines: list[str]) -> None:
        self.checked.show_objections(lines)

    def _look_for_broken_off(self) -> None:
        path = self.files.path
        if path is None:
            return
        if self._looking is not None:
            self._looking.cancel()
        self._looking = BackgroundTask(partial(_broken_off, self.starting.folder, path.stem), self)
        self._looking.done.connect(self.starting.show_broken_off)
        self._looking.start()

    def _show_what_may_be_done(self) -> None:
        """A run began or ended, or another session is shown."""
        running = self.controller.running
        self.starting.setVisible(not running)
        self.files.lock(running)
        has_session = self.controller.recorded is not None
        self.report_button.setEnabled(has_session)
        self.export_button.setEnabled(has_session)
        if self.controller.feed is not None:
            self.tabs.setCurrentWidget(self.now)
        if not running and self.controller.ending is not None:
            self._look_for_broken_off()

    @property
    def _ending(self) -> Ended | None:
        """Of the run whose recording is shown."""
        ending, shown = self.controller.ending, self.controller.recorded
        return ending if ending is not None and shown is not None and ending.session == shown.path else None

    def _show_question(self, state: SessionState) -> None:
        live = self.controller.live
        if live is None or not self.controller.running:
            self.banner.ask("")
            if not self.starting.isVisible():
                self._show_what_may_be_done()
            return
        if live.question is not None:
            self._ask(state, live.question)
        else:
            self.banner.ask(state.run.next_words if state.run.strikes else "")

    def _ask(self, state: SessionState, question: OperatorAsked) -> None:
        if question is self._asked and self.banner.isVisible():
            return
        self._asked = question
        self.banner.ask(state.run.question, question.what)
        if question.at_mm is None and question.mark != "clamp":
            return
        plate = state.configuration.the_specimen()
        # Nothing is asked of a place on anything else.
        assert isinstance(plate, PlateSpecimen)
        if question.free:
            whole_m = state.configuration.experiment.whole_length_m or plate.length_m
            plate = replace(plate, boundary="free", length_m=whole_m, pickup_m=None, further_pickups_m=())
        at_mm = question.at_mm or (0.0, 500 * plate.width_m)
        self.banner.show_place(plate, at_mm, question.mark, question.read_mm)

    # Inside

    def _connect(self) -> None:
        files, controller = self.files, self.controller
        files.chose.connect(controller.open)
        files.opened.connect(self._opened)
        files.edited.connect(self._edited)
        files.outdated.connect(self._outdated)
        self.plate.moved.connect(self._mark_moved)
        files.saved.connect(self._saved)
        files.failed.connect(self._failed)
        files.said.connect(controller.said)
        controller.experiment_chosen.connect(files.open)
        controller.changed.connect(self._show_what_may_be_done)
        self.starting.check_wanted.connect(self._check)
        self.starting.start_wanted.connect(self._start)
        self.starting.out_changed.connect(self._look_for_broken_off)
        self.banner.answered.connect(controller.commands.answer)
        self.banner.declined.connect(controller.commands.decline)
        self.check.passed.connect(self._passed)
        self.check.objected.connect(self._objected)
        self.report_button.clicked.connect(self.export.report)
        for said in (self.export.began, self.export.done):
            said.connect(controller.said)
        self.export.failed.connect(controller.refused)

    def _arrange(self) -> None:
        menu = QMenu(self.export_button)
        for kind, said in _FORMATS:
            action = menu.addAction(said)
            action.setData(kind)
            action.triggered.connect(self.export.data)
        self.export_button.setMenu(menu)
        self.tabs = QTabWidget()
        self.tabs.setDocumentMode(True)
        self.tabs.addTab(self.now, "State")
        self.tabs.addTab(self.checked, "Dry run")
        self.tabs.addTab(self.drawing, "Specimen")
        below = QHBoxLayout()
        below.setContentsMargins(6, 0, 6, 6)
        below.addStretch(1)
        below.addWidget(self.report_button)
        below.addWidget(self.export_button)
        right = QWidget()
        column = QVBoxLayout(right)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.starting)
        column.addWidget(self.tabs, 1)
        column.addLayout(below)
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(self.files)
        split.addWidget(right)
        split.setStretchFactor(0, 1)
        split.setStretchFactor(1, 1)
        split.setChildrenCollapsible(False)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addWidget(self.banner)
        whole.addWidget(split, 1)


def _broken_off(folder: Path, name: str, _: Progress) -> list[Path]:
    """Runs of this experiment that were not completed, the newest first."""
    return sorted(folder.glob(f"{name}-*.running"), reverse=True)
