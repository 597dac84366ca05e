"""The performance table as a person and as a program see it."""

import json

from click.testing import CliRunner

from instrument.bench.table import BenchLine
from instrument.cli.bench import bench

LINES = [BenchLine("set-up, cold", 2.0), BenchLine("set-up, cached", 0.5, 4.0, "set-up, cold", 1e-9)]


def test_each_line_says_how_many_times_faster_than_what(monkeypatch):
    monkeypatch.setattr("instrument.cli.bench.run_bench", lambda progress: LINES)
    said = CliRunner().invoke(bench, []).output
    assert "set-up, cached" in said
    assert "1.0e-09" in said


def test_the_json_has_a_row_for_each(monkeypatch):
    monkeypatch.setattr("instrument.cli.bench.run_bench", lambda progress: LINES)
    rows = json.loads(CliRunner().invoke(bench, ["--json", "-"]).output)["rows"]
    assert [set(row) for row in rows] == [{"name", "seconds", "ratio", "to", "max_relative_error"}] * 2
    assert rows[0]["ratio"] is None
    assert rows[1]["to"] == "set-up, cold"
