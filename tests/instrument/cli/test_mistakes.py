"""What a new user gets wrong is refused or questioned in one line with its cure, before any work."""

import re
import shutil

import pytest
from attacked_files import write_files
from mistakes.files import FILES
from mistakes.places import PLACES
from mistakes.rig import RIG
from mistakes.specimen import SPECIMEN
from mistakes.sweep import DATA, SHEETS, column, velocity

from instrument.cli.main import run

QUICK = (*SPECIMEN, *SHEETS, *FILES, *PLACES, *RIG)
"""Those that need no model of the plate."""


@pytest.fixture(scope="module")
def valid(tmp_path_factory):
    folder = tmp_path_factory.mktemp("valid")
    write_files(folder)
    return folder


@pytest.fixture
def here(valid, tmp_path, monkeypatch):
    shutil.copytree(valid, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def files_in(folder):
    return {path: path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def refused(capsys, here, mistake):
    """In one line, with nothing on standard output; no file is written or changed."""
    mistake.do(here)
    before = files_in(here)
    assert run(mistake.command.split()) == 2
    assert files_in(here) == before
    captured = capsys.readouterr()
    line = captured.err.strip()
    # `check` says all that is wrong at once.
    assert mistake.command.startswith("check") or "\n" not in line
    assert re.search(mistake.said, line), line
    assert captured.out == ""
    return line


@pytest.mark.parametrize("mistake", QUICK, ids=lambda m: m.name)
def test_a_mistake_is_one_line_with_its_cure(capsys, here, mistake):
    line = refused(capsys, here, mistake)
    assert ("--force" in line) == mistake.plausibility


@pytest.mark.parametrize("mistake", DATA, ids=lambda m: m.name)
def test_data_of_another_unit_sign_cable_or_plate_are_questioned(capsys, here, mistake):
    assert "--force" in refused(capsys, here, mistake)


def test_whoever_knows_better_insists(capsys, here):
    young = next(m for m in SPECIMEN if m.name == "substrate.young_gpa = 0.0689")
    young.do(here)
    assert run([*young.command.split(), "--force"]) == 0
    assert "frequency/Hz" in capsys.readouterr().out


def test_data_may_be_insisted_on(here):
    mistake = column("velocity in mm/s", lambda c: velocity(c, 1e3), "mm/s")
    mistake.do(here)
    assert run([*mistake.command.split(), "--force"]) == 0


def test_valid_files_are_not_questioned(here):
    assert run(["modes", "coarse.toml", "--count", "2"]) == 0
    assert run(["identify", "sweep.csv", "--specimen", "coarse.toml"]) == 0


def test_a_byte_order_mark_is_no_mistake(here):
    (here / "sweep.csv").write_bytes(b"\xef\xbb\xbf" + (here / "sweep.csv").read_bytes())
    assert run(["identify", "sweep.csv", "--specimen", "coarse.toml"]) == 0


def test_there_are_a_hundred_of_them():
    assert len(QUICK) + len(DATA) >= 100
