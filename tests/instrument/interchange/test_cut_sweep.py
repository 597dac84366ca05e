"""One sweep cut into several files, and files that are none."""

from pathlib import Path

import numpy as np
import pytest

from fitting.sweep import Sweep, segments_by_gap
from instrument.cli.main import run
from instrument.interchange.cut_sweep import looks_cut
from instrument.paper_case import case_file


def sweep(*bands, pickup=None):
    f = np.concatenate([np.linspace(a, b, 5) for a, b in bands])
    one = np.ones(len(f))
    spots = None if pickup is None else np.full(len(f), pickup)
    return Sweep(f, one + 0j, one, segments_by_gap(f), np.ones(len(f), dtype=int), pickup=spots)


def said(*sweeps, specimens=None):
    paths = [Path(f"{k}.csv") for k in range(len(sweeps))]
    return looks_cut(paths, sweeps, specimens or ["a"] * len(sweeps))


LOW, MIDDLE, HIGH = (14.0, 22.0), (80.0, 100.0), (250.0, 300.0)


def test_bands_side_by_side_or_between_each_other_look_like_one_sweep():
    assert said(sweep(LOW), sweep(MIDDLE), sweep(HIGH)).startswith("0.csv, 1.csv, 2.csv: of one specimen")
    assert said(sweep(LOW, HIGH), sweep(MIDDLE))


@pytest.mark.parametrize(
    "others",
    [
        ((sweep(LOW), sweep(LOW, HIGH)), None),
        ((sweep(LOW), sweep(HIGH)), ["a", "b"]),
        ((sweep(LOW), sweep(HIGH)), [None, None]),
        ((sweep(LOW, pickup=0), sweep(HIGH, pickup=1)), None),
        ((sweep(LOW, HIGH), sweep((15.0, 21.0), MIDDLE)), None),
    ],
)
def test_passes_other_specimens_sessions_and_spots_do_not(others):
    sweeps, specimens = others
    assert said(*sweeps, specimens=specimens) == ""


def test_the_command_says_it_before_it_fits(tmp_path, capsys):
    rows = case_file("table5.csv").read_text().splitlines()
    (head,) = [k for k, row in enumerate(rows) if row.startswith("frequency_hz")]
    paths = [tmp_path / "low.csv", tmp_path / "high.csv"]
    for path, some in zip(paths, (rows[head + 1 : head + 5], rows[head + 5 :]), strict=True):
        path.write_text("\n".join([rows[head], *some]))
    told = ["identify", *map(str, paths), "--specimen", str(case_file("zn1.toml")), "--pointwise", "--force"]
    assert run(told) == 2
    assert "low.csv, high.csv: of one specimen, in bands that do not overlap" in capsys.readouterr().out
