"""A session's report and its data for other programs: by the commands of that name."""

from functools import partial
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from gui.actions.controller import AppController
from gui.background.task import BackgroundCommand
from gui.background.writing import Writing
from gui.widgets.asking import ask_folder, ask_save
from instrument.facts.written import ExportResult, ReportResult
from instrument.files.acceleration import shown_as

_DOING = {"report": "the report is being written ...", "export": "the data are being written ..."}
_NAMED = 2
"""Files of which each is named."""


class Export(Writing):
    """Asks where to, then has it written.

    Signals
    -------
    began
        One line: what is being written.
    """

    began = Signal(str)

    def __init__(self, controller: AppController, window: QWidget) -> None:
        super().__init__(window)
        self._controller, self._window = controller, window

    def report(self) -> None:
        """One self-contained page."""
        self._ask_report("Save report", ".html", "Page (*.html)")

    def report_to_print(self) -> None:
        """The page of `report` on sheets of A4."""
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
        self.began.emit(_DOING[arguments[0]])
        self.write(BackgroundCommand(arguments, result, self))

    def said_of(self, found: object) -> str:
        """Names of files; of many, how many there are and where."""
        assert isinstance(found, ExportResult | ReportResult)
        files = (found.report,) if isinstance(found, ReportResult) else found.files
        # Of many their folder says more than all names.
        if len(files) > _NAMED:
            return f"wrote {len(files)} files into {Path(files[0]).parent}"
        return f"wrote {', '.join(files)}"

    @property
    def _session(self) -> Path | None:
        return self._controller.recorded.path if self._controller.recorded is not None else None
