"""The program around the window: what it says where there can be none, and the files it writes."""

import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtWidgets import QWidget

from gui import application, command
from gui.actions import export
from instrument.errors import BadInput
from instrument.facts.written import ExportResult


def test_without_a_screen_one_line_says_so(monkeypatch):
    monkeypatch.setattr(application.sys, "platform", "linux")
    for name in ("QT_QPA_PLATFORM", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    with pytest.raises(BadInput, match="no screen"):
        application.refuse_without_a_screen()
    monkeypatch.setenv("WAYLAND_DISPLAY", "wayland-0")
    application.refuse_without_a_screen()


@pytest.mark.parametrize(
    ("missing", "said"),
    [
        ("pyqtgraph", r"^the window needs pyqtgraph: pip install 'viscorig\[gui\]'$"),
        ("libEGL", "^the window cannot start: not here: apt-get install"),
    ],
)
def test_what_a_window_lacks_is_said_in_one_line(monkeypatch, missing, said):
    def run(session):
        raise ImportError("not here", name=missing)

    class Application:
        def __getattr__(self, name):
            run(None)

    monkeypatch.setitem(sys.modules, "gui.application", Application())
    with pytest.raises(BadInput, match=said):
        command.gui.callback(None)


@pytest.fixture
def exporting(qtbot, monkeypatch, tmp_path):
    """Of a recorded session; what is asked of the command, and where to, without either."""
    ran = []
    parent = QWidget()
    qtbot.addWidget(parent)
    recorded = SimpleNamespace(path=tmp_path / "one.h5")
    made = export.Export(SimpleNamespace(recorded=recorded), parent)
    monkeypatch.setattr(made, "_run", lambda arguments, result: ran.append(arguments))
    return made, ran


def test_what_is_being_written_is_said(qtbot, monkeypatch, tmp_path):
    heard, parent = [], QWidget()
    qtbot.addWidget(parent)
    monkeypatch.setattr(export.BackgroundCommand, "start", lambda command: heard.append("started"))
    made = export.Export(SimpleNamespace(recorded=None), parent)
    made.began.connect(heard.append)
    made._report(tmp_path / "one.h5", ".html", tmp_path / "one.html")
    made._data(tmp_path / "one.h5", "csv", tmp_path)
    assert heard == [
        "the report is being written ...",
        "started",
        "the data are being written ...",
        "started",
    ]


@pytest.mark.parametrize(("given", "written"), [("mine", "mine.html"), ("mine.HTML", "mine.HTML")])
def test_a_report_is_what_its_name_ends_with(exporting, monkeypatch, tmp_path, given, written):
    made, ran = exporting
    monkeypatch.setattr(export, "ask_save", lambda *asked: asked[-1](tmp_path / given))
    made.report()
    assert ran[0][:4] == ["report", str(tmp_path / "one.h5"), "--out", str(tmp_path / written)]


@pytest.mark.parametrize(
    ("count", "said"), [(2, "wrote a/0.csv, a/1.csv"), (3, f"wrote 3 files into {Path('a')}")]
)
def test_of_many_files_their_folder_is_said(exporting, count, said):
    made, heard = exporting[0], []
    made.done.connect(heard.append)
    made._written(ExportResult.model_construct(files=tuple(f"a/{k}.csv" for k in range(count))))
    assert heard == [said]
