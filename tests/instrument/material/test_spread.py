"""A spread between specimens is told from what is not known of each; where there is none, none is found."""

import json

import numpy as np
import pytest
from found_law_cases import ERRORS, facts
from paper_law import TABLE_4

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.material.found_law import read_law
from instrument.material.spread import spread_of


def specimens(folder, spread, seed, count=12):
    """Laws whose modulus as a whole differs by `spread`, each known to `ERRORS` and off by them."""
    rng, paths = np.random.default_rng(seed), []
    for k in range(count):
        own = np.exp(ERRORS * rng.standard_normal(4)) * TABLE_4.values
        level = np.exp(spread * rng.standard_normal())
        own[:2] *= level
        path = folder / f"{seed}-{k}.json"
        path.write_text(json.dumps(facts(TABLE_4.with_values(own))), encoding="utf-8")
        paths.append(path)
    return paths


def test_four_percent_between_twelve_specimens_lie_in_the_interval(tmp_path):
    found = [spread_of([read_law(p) for p in specimens(tmp_path, 0.04, seed)]) for seed in range(12)]
    inside = [s.lower < 0.04 < s.upper for one in found for s in one.storage]
    assert np.mean(inside) > 0.88
    assert np.mean([s.value for one in found for s in one.storage]) == pytest.approx(0.04, rel=0.25)


def test_specimens_that_are_alike_have_next_to_no_spread(tmp_path):
    found = [spread_of([read_law(p) for p in specimens(tmp_path, 0.0, seed)]) for seed in range(12)]
    assert np.median([s.value for one in found for s in one.storage]) < 0.01
    assert np.mean([s.lower == 0 for one in found for s in one.storage]) > 0.88
    assert np.median([s.value for one in found for s in one.loss]) < 0.01


def test_the_common_law_is_between_them_all(tmp_path):
    found = spread_of([read_law(p) for p in specimens(tmp_path, 0.04, 3)])
    storage, eta = TABLE_4.storage_and_loss(2 * np.pi * found.frequency_hz)
    assert np.all(np.abs(np.log(found.storage_modulus_pa / storage)) < 4 * found.storage_error)
    assert np.all(np.abs(np.log(found.loss_factor / eta)) < 4 * found.loss_factor_error)


def test_two_laws_tell_no_spread(tmp_path):
    with pytest.raises(BadInput, match="2 laws, expected 3"):
        spread_of([read_law(p) for p in specimens(tmp_path, 0.04, 0, 2)])


def test_the_command_says_the_spread(tmp_path, capsys):
    paths = [str(p) for p in specimens(tmp_path, 0.04, 1)]
    out = tmp_path / "spread.json"
    assert run(["compare", "--spread", *paths, "--json", str(out)]) == 0
    assert "spread between 12 specimens" in capsys.readouterr().out
    said = json.loads(out.read_text())["spread"]
    low, high = said["frequencies"][3]["storage_modulus_spread"]["interval_95_percent"]
    assert low < 4 < high


def test_a_law_of_an_unknown_verdict_is_not_in_the_spread(tmp_path, capsys):
    paths = specimens(tmp_path, 0.04, 2, 5)
    biased = TABLE_4.with_values(TABLE_4.values * np.array([1.5, 1.5, 1.0, 1.0]))
    paths[0].write_text(json.dumps({"verdict": "unknown", "after": facts(biased)}), encoding="utf-8")
    assert run(["compare", "--spread", *map(str, paths)]) == 0
    said = capsys.readouterr().out
    assert "2-0.json: verdict unknown" in said
    assert "is not in the spread" in said
    assert "spread between 4 specimens" in said
    with pytest.raises(BadInput, match="2 laws, 1 more of verdict unknown or in doubt, expected 3"):
        spread_of([read_law(p) for p in paths[:3]])


def test_a_law_that_is_given_twice_is_refused(tmp_path, capsys):
    paths = specimens(tmp_path, 0.04, 4, 4)
    copy = tmp_path / "copy.json"
    copy.write_bytes(paths[1].read_bytes())
    assert run(["compare", "--spread", *map(str, paths), str(copy)]) == 2
    assert "4-1.json and copy.json: the same law to the last digit" in capsys.readouterr().err


def test_the_command_names_a_specimen_that_is_not_like_the_others(tmp_path, capsys):
    paths = specimens(tmp_path, 0.01, 5, 6)
    stiff = TABLE_4.with_values(TABLE_4.values * np.array([1.5, 1.5, 1.0, 1.0]))
    paths[2].write_text(json.dumps(facts(stiff)), encoding="utf-8")
    out = tmp_path / "spread.json"
    assert run(["compare", "--spread", *map(str, paths), "--json", str(out)]) == 0
    said = capsys.readouterr().out
    assert "5-2.json is apart from the 5 other specimens: G' +" in said
    assert "without it: spread between 5 specimens" in said
    found = json.loads(out.read_text())["spread"]
    assert [one["name"] for one in found["apart"]] == ["5-2.json"]
    spreads = [
        rows[3]["storage_modulus_spread"]["percent"]
        for rows in (found["frequencies"], found["without_apart"])
    ]
    assert spreads[0] > 10 > 5 > spreads[1]
