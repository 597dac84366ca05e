"""Intervals beyond the linear errors, as a command prints and writes them."""

import json

import numpy as np
import pytest
from data_folder import DATA
from json_schema import faults

from instrument.cli.main import run
from instrument.facts.schema import schema_of

NUMBERS = DATA / "numbers"
KINDS = ("profile", "bootstrap")


@pytest.fixture(scope="module", params=KINDS)
def looked(request, tmp_path_factory):
    """Nine amplitudes, which say little of what the law does elsewhere."""
    path = tmp_path_factory.mktemp("in depth") / "found.json"
    words = ["identify", NUMBERS / "table5.csv", "--specimen", NUMBERS / "coarse.toml"]
    words += ["--uncertainty", request.param, "--json", path]
    assert run([str(word) for word in words]) == 0
    return json.loads(path.read_text())


def test_it_is_written_as_the_schema_says(looked):
    assert faults(looked, schema_of("identify")) == []


def test_intervals_hold_the_best_value_and_the_wider_one_the_narrower(looked):
    assert looked["uncertainty"]
    for one in looked["uncertainty"]:
        assert one["quantities"]
        for q in one["quantities"]:
            (a, b), (c, d) = q["interval_95_percent"], q["interval_68_percent"]
            ends = [x for x in (a, c, d, b) if x is not None and np.isfinite(x)]
            assert ends == sorted(ends), (one["method"], q["quantity"])
