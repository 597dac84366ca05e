import json

import pytest

from instrument.cli.main import run
from instrument.processes.other_processes import VARIABLE


@pytest.mark.timing
def test_bench_shows_the_required_ratios(capsys, monkeypatch):
    monkeypatch.delenv(VARIABLE)
    assert run(["bench", "--json", "-"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    by_name = {row["name"]: row for row in rows}
    assert set(rows[0]) == {"name", "seconds", "ratio", "to", "max_relative_error"}
    assert by_name["one law over 353 frequencies"]["ratio"] > 1e5
    assert by_name["set-up, cold, and identification together"]["ratio"] > 50
    (reduced,) = (row for name, row in by_name.items() if name.startswith("reduced model"))
    assert reduced["max_relative_error"] < 1e-6
    whole = {name: row["seconds"] for name, row in by_name.items() if name.startswith("diagnosis, the whole")}
    # Seconds are for people to read: on a busy machine they say nothing.
    assert len(whole) == 2
    assert by_name["set-up, cached"]["ratio"] > 5
