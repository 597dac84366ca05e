"""A file is written whole or not at all."""

import os
from pathlib import Path

import pytest

from instrument.errors import BadInput
from instrument.files.at_once import at_once, refuse_unwritable, write_at_once


def half_written(path, error):
    with at_once(path) as draft:
        draft.write_text("half of it")
        raise error


def test_what_was_there_stays_where_the_new_one_cannot_be_written(tmp_path):
    path = tmp_path / "result.json"
    path.write_text("before")
    with pytest.raises(BadInput, match=r"result\.json: File too large"):
        half_written(path, OSError(27, "File too large"))
    assert path.read_text() == "before"
    assert os.listdir(tmp_path) == ["result.json"]
    write_at_once(path, "after")
    assert path.read_text() == "after"
    assert os.listdir(tmp_path) == ["result.json"]


def test_a_file_that_was_not_there_is_not_there_after_a_failure(tmp_path):
    with pytest.raises(RuntimeError):
        half_written(tmp_path / "new.csv", RuntimeError())
    assert os.listdir(tmp_path) == []


def test_a_device_is_written_to_and_a_link_leads_to_what_is_written(tmp_path):
    write_at_once(Path(os.devnull), "gone")
    assert not os.path.isfile(os.devnull)
    real, link = tmp_path / "real.txt", tmp_path / "link.txt"
    real.write_text("before")
    link.symlink_to(real)
    write_at_once(link, "after")
    assert link.is_symlink()
    assert real.read_text() == "after"


def test_a_folder_that_is_not_there_is_said(tmp_path):
    with pytest.raises(BadInput, match="No such file or directory"):
        write_at_once(tmp_path / "no" / "x.txt", "text")


def test_what_cannot_be_written_is_refused_beforehand(tmp_path, monkeypatch):
    (tmp_path / "there.json").write_text("x")
    closed = [tmp_path / "there.json", tmp_path / "new.json", tmp_path / "figures" / "of it", tmp_path]
    for path in closed:
        refuse_unwritable(path)
    # Not by the folder's mode: who runs the tests may write everywhere.
    monkeypatch.setattr(os, "access", lambda folder, _: Path(folder) != tmp_path)
    for path in closed:
        with pytest.raises(BadInput, match="Permission denied: nothing can be written in"):
            refuse_unwritable(path)
    refuse_unwritable(Path(os.devnull))
