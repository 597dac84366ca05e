"""The repeatability over remounts is a variance of its own: found where there are several, else stated."""

import json
from dataclasses import replace

import numpy as np
import pytest
from found_law_cases import ERRORS, facts
from paper_law import TABLE_4

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.material.comparing import compare
from instrument.material.found_law import read_law
from instrument.material.spread import spread_of

MOUNTING = 0.03
"""Standard deviation from mount to mount that the laws here are made with."""


def mounts(folder, seed, count, spread=MOUNTING):
    """Laws of one specimen: each known to `ERRORS`, off by them, and by how it was mounted."""
    rng, paths = np.random.default_rng(seed), []
    for k in range(count):
        own = np.exp(ERRORS * rng.standard_normal(4)) * TABLE_4.values
        own[:2] *= np.exp(spread * rng.standard_normal())
        path = folder / f"mount{seed}-{k}.json"
        path.write_text(json.dumps(facts(TABLE_4.with_values(own))), encoding="utf-8")
        paths.append(path)
    return paths


def test_the_repeatability_that_mounts_have_lies_in_its_interval(tmp_path):
    found = [spread_of([read_law(p) for p in mounts(tmp_path, seed, 6)], "mounts") for seed in range(12)]
    inside = [s.lower < MOUNTING < s.upper for one in found for s in one.storage]
    assert np.mean(inside) > 0.85
    assert np.median([s.value for one in found for s in one.storage]) == pytest.approx(MOUNTING, rel=0.3)


def test_mounts_that_change_nothing_need_no_repeatability(tmp_path):
    found = [spread_of([read_law(p) for p in mounts(tmp_path, seed, 6, 0.0)], "mounts") for seed in range(12)]
    assert np.mean([s.lower == 0 for one in found for s in one.storage]) > 0.85


def test_a_stated_repeatability_keeps_mounts_from_differing(tmp_path):
    badly = 0.15
    laws = [read_law(p) for p in mounts(tmp_path, 0, 24, badly)]
    pairs = list(zip(laws[::2], laws[1::2], strict=True))
    assert np.mean([compare(a, b).differs for a, b in pairs]) > 0.5
    assert np.mean([compare(a, b, badly).differs for a, b in pairs]) < 0.2


def test_one_mount_counted_twice_is_refused(tmp_path):
    laws = [replace(read_law(p), remount=k) for p, k in zip(mounts(tmp_path, 1, 3), (0, 1, 1), strict=True)]
    with pytest.raises(BadInput, match="both remount = 1, expected a mount each"):
        spread_of(laws, "mounts")
    other = [replace(law, remount=k, specimen=f"{k}.toml") for k, law in enumerate(laws)]
    with pytest.raises(BadInput, match="expected one specimen"):
        spread_of(other, "mounts")


def test_the_command_says_it(tmp_path, capsys):
    paths, out = [str(p) for p in mounts(tmp_path, 2, 5)], tmp_path / "repeatability.json"
    assert run(["compare", "--remounts", *paths, "--json", str(out)]) == 0
    assert "repeatability over 5 mounts" in capsys.readouterr().out
    low, high = json.loads(out.read_text())["repeatability"]["frequencies"][3]["storage_modulus_spread"][
        "interval_95_percent"
    ]
    assert low < 100 * MOUNTING < high
    assert run(["compare", *paths[:2], "--repeatability", "3", "--json", str(out)]) == 0
    assert json.loads(out.read_text())["pairs"][0]["repeatability_percent"] == 3.0
    assert run(["compare", *paths, "--remounts", "--repeatability", "3"]) == 2
