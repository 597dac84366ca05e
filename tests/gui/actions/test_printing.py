"""The report on a printer: asked for, drawn by the command, painted sheet by sheet."""

import re
from pathlib import Path

import pytest
from openers import close_all, opened_by, openers
from PySide6.QtGui import QColor, QImage
from PySide6.QtPrintSupport import QAbstractPrintDialog, QPrintDialog, QPrinter

import gui.actions.printing
from gui.actions.controller import AppController
from gui.actions.printing import paint
from gui.background.task import BackgroundCommand
from instrument.errors import BadInput
from instrument.facts.written import ReportResult

COUNT = 3


@pytest.fixture
def sheets(tmp_path):
    """Small ones."""
    paths = tuple(tmp_path / f"sheet-{k}.png" for k in range(COUNT))
    for k, path in enumerate(paths):
        image = QImage(210, 297, QImage.Format.Format_RGB32)
        image.fill(QColor.fromHsv(90 * k, 200, 200))
        assert image.save(str(path))
    return paths


@pytest.fixture
def printer(qapp, tmp_path):
    """A file."""
    made = QPrinter(QPrinter.PrinterMode.ScreenResolution)
    made.setOutputFileName(str(tmp_path / "printed.pdf"))
    return made


def quiet(fraction):
    assert 0 <= fraction < 1


def pages(printer):
    return len(re.findall(rb"/Type\s*/Page\b", Path(printer.outputFileName()).read_bytes()))


def test_every_sheet_is_a_page(printer, sheets):
    assert paint(printer, sheets, quiet) == COUNT
    assert pages(printer) == COUNT


def test_some_pages_are_printed_where_some_are_asked_for(printer, sheets):
    printer.setFromTo(2, 3)
    assert paint(printer, sheets, quiet) == 2
    assert pages(printer) == 2


def test_pages_that_are_not_there_are_refused(printer, sheets):
    printer.setFromTo(7, 9)
    with pytest.raises(BadInput, match="sheets 7 to 9: the report has 3"):
        paint(printer, sheets, quiet)


@pytest.mark.qt_log_ignore("QPainter::begin")
def test_what_cannot_be_printed_on_is_said(printer, sheets, tmp_path):
    printer.setOutputFileName(str(tmp_path / "nowhere" / "printed.pdf"))
    with pytest.raises(BadInput, match=r"printed\.pdf: cannot be printed on"):
        paint(printer, sheets, quiet)


def ask(window):
    """The dialog of the menu's entry."""
    return opened_by(next(o for o in openers(window) if o[0] == "Pr&int report..."))


def test_without_a_printer_the_pdf_is_named(opened, monkeypatch):
    monkeypatch.setattr(gui.actions.printing, "has_printer", lambda: False)
    opened.menus._printing.ask()
    assert "Save report as PDF" in opened.notice.text


def test_the_command_draws_what_the_dialog_prints(qtbot, opened, sheets, printer, monkeypatch):
    monkeypatch.setattr(gui.actions.printing, "has_printer", lambda: True)
    asked = []

    def draws(command):
        asked.append(command._process.arguments())
        command.done.emit(ReportResult(report="sheet.png", sheets=tuple(map(str, sheets))))

    monkeypatch.setattr(BackgroundCommand, "start", draws)
    dialog = ask(opened)
    assert isinstance(dialog, QPrintDialog)
    assert not dialog.isModal()
    assert not dialog.testOption(QAbstractPrintDialog.PrintDialogOption.PrintToFile)
    dialog.printer().setOutputFileName(printer.outputFileName())
    dialog.accepted.emit(dialog.printer())
    qtbot.waitUntil(lambda: f"{COUNT} sheets sent to" in opened.notice.text)
    assert pages(printer) == COUNT
    (arguments,) = asked
    assert "report" in arguments
    assert not Path(arguments[arguments.index("--out") + 1]).parent.exists()
    close_all()


def test_a_dialog_of_the_system_waits_for_the_end_of_a_run(opened, monkeypatch):
    monkeypatch.setattr(gui.actions.printing, "_OWN_DIALOG", False)
    monkeypatch.setattr(AppController, "running", property(lambda controller: True))
    opened.menus._printing.ask()
    assert "print after the run" in opened.notice.text
