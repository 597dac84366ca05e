"""Files and specimens asked for: the window's own dialogs, none of them modal."""

from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QUrl
from PySide6.QtWidgets import QFileDialog, QWidget

from gui.actions.rediagnosis import Rediagnosis
from gui.actions.taking_together import ask_hammer, ask_specimen, ask_together, paths_of
from gui.actions.together import Together
from gui.files.pairing import PairedFile


@pytest.fixture
def owner(made):
    return made(QWidget())


@pytest.fixture
def together(qapp):
    return Together(Rediagnosis())


def dialog_of(owner):
    (dialog,) = owner.findChildren(QFileDialog)
    assert not dialog.isModal()
    return dialog


def answer(owner, paths, monkeypatch):
    dialog = dialog_of(owner)
    monkeypatch.setattr(dialog, "selectedFiles", lambda: [str(path) for path in paths])
    dialog.accepted.emit()
    dialog.close()
    return dialog


def test_files_come_all_at_once(owner, together, monkeypatch, tmp_path):
    told = []
    together.changed.connect(lambda: told.append(len(together.files)))
    ask_together(owner, together)
    answer(owner, [tmp_path / "a.csv", tmp_path / "b.csv"], monkeypatch)
    assert told == [2]


def test_a_hammer_test_is_asked_for_beside_the_data(owner, together, monkeypatch, tmp_path):
    together.add([tmp_path / "a.csv"])
    ask_hammer(owner, together)
    dialog = answer(owner, [tmp_path / "hits.json"], monkeypatch)
    assert dialog.directory().absolutePath() == str(tmp_path)
    assert together.hammer == tmp_path / "hits.json"


def test_the_specimen_of_one_file_says_whose_it_is(owner, together, monkeypatch, tmp_path):
    together.add([tmp_path / "a.csv", tmp_path / "b.csv"])
    ask_specimen(owner, together, 1)
    dialog = answer(owner, [tmp_path / "p.toml"], monkeypatch)
    assert dialog.windowTitle() == "Specimen of file 2, b.csv"
    assert together.files[1].specimen == tmp_path / "p.toml"


def test_a_file_taken_away_meanwhile_is_not_given_a_specimen(owner, together, monkeypatch, tmp_path):
    together.add([tmp_path / "a.csv", tmp_path / "b.csv"])
    ask_specimen(owner, together, 1)
    together.remove(1)
    answer(owner, [tmp_path / "p.toml"], monkeypatch)
    assert together.files == (PairedFile(tmp_path / "a.csv"),)


def test_of_what_is_dropped_data_and_specimens_are_taken(tmp_path):
    dropped = QMimeData()
    names = ("a.csv", "b.h5", "p.toml", "photo.png")
    dropped.setUrls([QUrl.fromLocalFile(str(tmp_path / n)) for n in names] + [QUrl("http://x.org/c.csv")])
    assert paths_of(dropped) == [tmp_path / n for n in names[:3]]
    assert paths_of(QMimeData()) == []
    assert isinstance(paths_of(dropped)[0], Path)
