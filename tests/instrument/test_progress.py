import json

from instrument.progress import LINES, bar


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
