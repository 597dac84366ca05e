import json

import pytest

from instrument.cli.main import run
from instrument.second_process import VARIABLE


@pytest.mark.timing
def test_bench_shows_the_required_ratios(capsys, monkeypatch):
    monkeypatch.delenv(VARIABLE)
    assert run(["bench", "--json", "-"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    by_name = {row["name"]: row for row in rows}
    assert set(rows[0]) == {"name", "seconds", "ratio", "to", "max_relative_error"}
    assert by_name["one law over 353 frequencies"]["ratio"] > 1e5
    assert by_name["set-up, cold, and identification together"]["ratio"] > 50
    assert by_name["set-up, cold"]["seconds"] < 15
    assert by_name["set-up, cached"]["seconds"] < 1
    assert by_name["identification of 9 points"]["seconds"] < 0.05
    assert by_name["identification of 353 complex points"]["seconds"] < 0.1
    (reduced,) = (row for name, row in by_name.items() if name.startswith("reduced model"))
    assert reduced["max_relative_error"] < 1e-6
    assert by_name["set-up of a diagnosis, cold"]["seconds"] < 30
    whole = {name: row["seconds"] for name, row in by_name.items() if name.startswith("diagnosis, the whole")}
    assert whole["diagnosis, the whole catalogue, 353 points at 1 level"] < 5
    assert whole["diagnosis, the whole catalogue, 1059 points at 3 levels"] < 20
