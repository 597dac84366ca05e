import errno
import io
import json
import os

import pytest

from instrument.progress import LINES, Screen, bar


def test_a_program_that_asks_is_told_in_lines(monkeypatch, capsys):
    monkeypatch.setenv(LINES, "lines")
    with bar("fitting") as report:
        for k in range(1001):
            report(k / 1000)
    told = [json.loads(line) for line in capsys.readouterr().err.splitlines()]
    assert {t["work"] for t in told} == {"fitting"}
    assert told[-1]["fraction"] > 0.98
    assert 50 < len(told) < 102


def test_a_pipe_hears_nothing(monkeypatch, capsys):
    monkeypatch.delenv(LINES, raising=False)
    with bar("fitting") as report:
        report(0.5)
    assert capsys.readouterr() == ("", "")


class Vanished(io.StringIO):
    """A terminal that was closed, or a disk that is full."""

    def __init__(self, number):
        super().__init__()
        self.number = number

    def isatty(self):
        return True

    def write(self, text):
        raise OSError(self.number, os.strerror(self.number))


def test_a_terminal_that_vanishes_silences_a_bar_and_ends_no_work(monkeypatch):
    monkeypatch.delenv(LINES, raising=False)
    monkeypatch.setattr("sys.stderr", Vanished(errno.EIO))
    with bar("fitting") as report:
        report(0.5)
    screen = Screen(stderr=True)
    screen.print("a line")
    assert screen.quiet


def test_what_else_goes_wrong_with_an_output_is_said():
    with pytest.raises(OSError, match=os.strerror(errno.ENOSPC)):
        Screen(file=Vanished(errno.ENOSPC)).print("a line")
