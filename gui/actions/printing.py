"""A recorded session's report on paper: the sheets of the PDF, sent to a printer.

Drawn by the command in its own process, painted in a thread; the dialog is Qt's own, which is not modal.
"""

import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QDir, QObject, QRectF, QSizeF, Qt, QTemporaryDir, Signal
from PySide6.QtGui import QImage, QPageSize, QPainter
from PySide6.QtPrintSupport import QAbstractPrintDialog, QPrintDialog, QPrinter, QPrinterInfo
from PySide6.QtWidgets import QWidget

from gui.actions.controller import AppController
from gui.background.task import BackgroundCommand, BackgroundTask, Progress
from gui.widgets.asking import show
from instrument.errors import BadInput
from instrument.facts.written import ReportResult
from instrument.files.acceleration import shown_as

_TITLE = "Print report"
_OWN_DIALOG = sys.platform.startswith("linux")
"""Whether the dialog is Qt's. Elsewhere it is the system's, which keeps mouse and keyboard to itself."""


class Printing(QObject):
    """Asks for a printer, then has the sheets drawn and prints them."""

    done = Signal(str)
    failed = Signal(str)

    def __init__(self, controller: AppController, window: QWidget) -> None:
        super().__init__(window)
        self._controller, self._window = controller, window

    def ask(self) -> None:
        """For a printer."""
        if self._controller.recorded is None:
            return
        if self._controller.running and not _OWN_DIALOG:
            self.failed.emit("this system's print dialog would stand before STOP: print after the run")
            return
        if not has_printer():
            self.failed.emit("no printer is set up on this computer: File > Save report as PDF")
            return
        session = self._controller.recorded.path
        printer = QPrinter(QPrinter.PrinterMode.HighResolution)
        printer.setPageSize(QPageSize(QPageSize.PageSizeId.A4))
        printer.setFullPage(True)
        printer.setDocName(session.stem)
        dialog = QPrintDialog(printer, self._window)
        dialog.setWindowTitle(_TITLE)
        dialog.setOption(QAbstractPrintDialog.PrintDialogOption.PrintCurrentPage, False)
        # A PDF has an entry of its own; of a file that cannot be written Qt would ask in a box of its own.
        dialog.setOption(QAbstractPrintDialog.PrintDialogOption.PrintToFile, False)
        dialog.accepted.connect(partial(self._draw, session, printer))
        show(dialog, self._window, _TITLE)

    def _draw(self, session: Path, printer: QPrinter, *_: QPrinter) -> None:
        """The dialog's signal says the printer once more, as a thing that Qt may let go of."""
        job = _Job(session, printer, self)
        job.done.connect(self.done)
        job.failed.connect(self.failed)
        job.start()


class _Job(QObject):
    """One report on its way to one printer."""

    done = Signal(str)
    failed = Signal(str)

    def __init__(self, session: Path, printer: QPrinter, parent: QObject) -> None:
        super().__init__(parent)
        self._printer = printer
        # Goes with the job, also where the window is closed in the middle.
        self._folder = QTemporaryDir(QDir.tempPath() + "/viscorig-print-XXXXXX")
        sheets = Path(self._folder.path()) / "sheet.png"
        self._command = BackgroundCommand(
            ["report", str(session), "--out", str(sheets), *shown_as()], ReportResult, self
        )
        self._command.done.connect(self._drawn)
        self._command.failed.connect(self._failed)

    def start(self) -> None:
        """Draw the sheets."""
        self._command.start()

    def _drawn(self, found: ReportResult) -> None:
        work = partial(paint, self._printer, tuple(Path(sheet) for sheet in found.sheets))
        task = BackgroundTask(work, self)
        task.done.connect(self._printed)
        task.failed.connect(self._failed)
        task.start()

    def _printed(self, sheets: int) -> None:
        self.done.emit(f"{sheets} sheets sent to {_name(self._printer)}")
        self._end()

    def _failed(self, message: str) -> None:
        self.failed.emit(message)
        self._end()

    def _end(self) -> None:
        self._folder.remove()
        self.deleteLater()


def has_printer() -> bool:
    """Whether this computer knows one."""
    return bool(QPrinterInfo.availablePrinterNames())


def paint(printer: QPrinter, sheets: Sequence[Path], progress: Progress) -> int:
    """Sheets on paper, as many as the printer was asked for. Raises `BadInput` where it takes none."""
    first, last = max(printer.fromPage(), 1), printer.toPage() or len(sheets)
    wanted = sheets[first - 1 : last]
    if not wanted:
        raise BadInput(f"sheets {first} to {last}: the report has {len(sheets)}")
    painter = QPainter()
    if not painter.begin(printer):
        raise BadInput(f"{_name(printer)}: cannot be printed on")
    try:
        for k, sheet in enumerate(wanted):
            progress(k / len(wanted))
            if k and not printer.newPage():
                raise BadInput(f"{_name(printer)}: took {k} of {len(wanted)} sheets")
            image = QImage(str(sheet))
            painter.drawImage(_inside(printer, image), image)
    finally:
        painter.end()
    return len(wanted)


def _inside(printer: QPrinter, image: QImage) -> QRectF:
    """The whole sheet of paper; of another format, as large as A4 fits in its middle."""
    paper = QRectF(printer.pageLayout().fullRectPixels(printer.resolution()))
    size = QSizeF(image.size()).scaled(paper.size(), Qt.AspectRatioMode.KeepAspectRatio)
    at = QRectF(paper.topLeft(), size)
    at.moveCenter(paper.center())
    return at


def _name(printer: QPrinter) -> str:
    return printer.outputFileName() or printer.printerName() or "the printer"
