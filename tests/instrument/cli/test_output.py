"""What a command prints, and what it writes though nobody reads."""

import io
import json
import sys
from pathlib import Path

import pytest
from called import call

from instrument.cli.output import Output
from instrument.facts.result import Result
from instrument.files.new_file import TEMPLATES


class Facts(Result):
    answer: int


class Deaf(io.StringIO):
    """A terminal or pager that has gone."""

    def write(self, _):
        raise BrokenPipeError


def test_the_file_is_written_though_the_reader_of_the_tables_has_gone(tmp_path, monkeypatch):
    out = Output(str(tmp_path / "found.json"))
    monkeypatch.setattr(sys, "stdout", Deaf())
    out.say("a line")
    out.table("a table", ["f/Hz", "G'/MPa"], [["20", "0.3"]])
    out.result(Facts(answer=42))
    assert json.loads((tmp_path / "found.json").read_text()) == {"answer": 42}


def test_numbers_stand_to_the_right_under_their_head(capsys):
    Output(None).table("law", ["f/Hz", "G'/MPa"], [["20", "0.3"], ["100", "0.45"]])
    assert capsys.readouterr().out.splitlines() == ["law", "f/Hz  G'/MPa", "  20     0.3", " 100    0.45"]


@pytest.mark.parametrize(
    "words",
    [
        ("modes", TEMPLATES["plate"], "--json", "found.json"),
        ("diagnose", "none.csv", "--figures", "figures/new"),
        ("plan", TEMPLATES["plate"], "--experiment", "e.toml"),
    ],
)
def test_what_could_not_be_written_is_refused_before_the_work(words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("os.access", lambda path, *_: Path(path) != tmp_path)
    status, out, err = call(capsys, *words)
    assert (status, out) == (2, "")
    assert f"{words[-1]}: Permission denied: nothing can be written in {tmp_path}" in err
