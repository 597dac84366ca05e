"""A session's report and its data for other programs: by the commands of that name."""

from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from gui.asking import ask_folder, ask_save
from gui.background_task import BackgroundCommand
from gui.controller import AppController
from instrument.facts.written import ExportResult, ReportResult
from instrument.files.acceleration import shown_as

_DOING = {"report": "the report is being written ...", "export": "the data are being written ..."}
_NAMED = 2
"""Files of which each is named."""


class Export(QObject):
    """Asks where to, then has it written.

    Signals
    -------
    began, done, failed
        One line: what is being written, what was, why it is not.
    """

    began = Signal(str)
    done = Signal(str)
    failed = Signal(str)

    def __init__(self, controller: AppController, window: QWidget) -> None:
        super().__init__(window)
        self._controller, self._window = controller, window

    def report(self) -> None:
        """One self-contained page."""
        self._ask_report("Save report", ".html", "Page (*.html)")

    def report_to_print(self) -> None:
        """The same on sheets of A4."""
        self._ask_report("Save report as PDF", ".pdf", "Sheets of A4 (*.pdf)")

    def data(self) -> None:
        """For the program that the menu's entry names."""
        action, session = self.sender(), self._session
        if session is None or not isinstance(action, QAction):
            return
        then = partial(self._data, session, str(action.data()))
        ask_folder(self._window, "Export data to", str(session.parent), then)

    def _ask_report(self, title: str, ending: str, kinds: str) -> None:
        session = self._session
        if session is None:
            return
        then = partial(self._report, session, ending)
        ask_save(self._window, title, str(session.with_suffix(ending)), kinds, then)

    def _report(self, session: Path, ending: str, to: Path) -> None:
        """What is written is what the ending says."""
        to = to if to.suffix.lower() == ending else to.with_name(to.name + ending)
        self._run(["report", str(session), "--out", str(to), *shown_as()], ReportResult)

    def _data(self, session: Path, kind: str, folder: Path) -> None:
        self._run(["export", str(session), "--to", kind, "--out", str(folder)], ExportResult)

    def _run(self, arguments: list[str], result: type[ExportResult] | type[ReportResult]) -> None:
        command = BackgroundCommand(arguments, result, self)
        command.done.connect(self._written)
        command.failed.connect(self._not_written)
        self.began.emit(_DOING[arguments[0]])
        command.start()

    def _not_written(self, message: str) -> None:
        self._forget()
        self.failed.emit(message)

    def _forget(self) -> None:
        command = self.sender()
        if isinstance(command, BackgroundCommand):
            command.deleteLater()

    def _written(self, found: ExportResult | ReportResult) -> None:
        self._forget()
        files = (found.report,) if isinstance(found, ReportResult) else found.files
        # Of many their folder says more than all names.
        many = len(files) > _NAMED
        self.done.emit(
            f"wrote {len(files)} files into {Path(files[0]).parent}" if many else f"wrote {', '.join(files)}"
        )

    @property
    def _session(self) -> Path | None:
        return self._controller.recorded.path if self._controller.recorded is not None else None
