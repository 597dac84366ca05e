"""What laws of one specimen are off by together is no difference between them, nor makes them agree."""

import json

import numpy as np
import pytest
from found_law_cases import ERRORS, OF_ALL, OF_ONE, THICK, facts, of_tolerances
from paper_law import TABLE_4

from instrument.cli.main import run
from instrument.material.alike import alike_in, stated_unlike
from instrument.material.comparing import compare
from instrument.material.found_law import read_law
from instrument.material.spread import spread_of

STIFFER = np.array([np.log(1.07), np.log(1.07), 0.0, 0.0])


@pytest.fixture
def law_of(tmp_path):
    made = iter(range(10**6))

    def read(said):
        path = tmp_path / f"{next(made)}.json"
        path.write_text(json.dumps(said), encoding="utf-8")
        return read_law(path)

    return read


def measured(rng, thicker):
    """A law that is off by noise, by a spot set anew, and by a core that is so much thicker than stated."""
    off = ERRORS * rng.standard_normal(4) + OF_ONE * rng.standard_normal() + OF_ALL * thicker
    return TABLE_4.with_values(TABLE_4.values * np.exp(off))


def twice(law_of, rng):
    thicker = rng.standard_normal()
    return tuple(law_of(of_tolerances(measured(rng, thicker))) for _ in range(2))


def test_only_what_stays_with_the_specimen_is_alike(law_of):
    a, b = twice(law_of, np.random.default_rng(1))
    assert alike_in((a, b)) == (THICK["name"],)
    assert compare(a, b, one_specimen=True).alike == (THICK["name"],)
    assert compare(a, b).alike == ()


def test_numbers_stated_otherwise_are_not_alike(law_of):
    a = law_of(of_tolerances(TABLE_4))
    other = of_tolerances(TABLE_4)
    other["adjusted"] = [{**THICK, "stated": 1.1}, *other["adjusted"][1:]]
    assert alike_in((a, law_of(other))) == ()
    assert stated_unlike((a, law_of(other))) == (THICK["name"],)
    assert alike_in((a, law_of(facts(TABLE_4)))) == ()


def test_one_specimen_measured_twice_differs_by_chance_alone(law_of):
    rng = np.random.default_rng(7)
    p = [compare(*twice(law_of, rng), one_specimen=True).p_value for _ in range(200)]
    assert 0.01 <= np.mean(np.array(p) < 0.05) <= 0.10
    assert 0.35 < np.median(p) < 0.7


def test_a_change_within_a_tolerance_is_seen_of_one_specimen(law_of):
    rng, seen = np.random.default_rng(8), {True: 0, False: 0}
    for _ in range(40):
        thicker = rng.standard_normal()
        a, b = measured(rng, thicker), measured(rng, thicker)
        b = b.with_values(b.values * np.exp(2 * STIFFER))
        laws = law_of(of_tolerances(a)), law_of(of_tolerances(b))
        for one in seen:
            seen[one] += bool(compare(*laws, one_specimen=one).differs)
    assert seen[True] > 2 * seen[False]


def test_mounts_that_change_nothing_need_no_repeatability_and_the_mean_keeps_the_tolerance(law_of):
    rng, none_needed, means = np.random.default_rng(9), [], []
    for _ in range(24):
        thicker = rng.standard_normal()
        found = spread_of([law_of(of_tolerances(measured(rng, thicker))) for _ in range(5)], "mounts")
        k = found.middle
        none_needed.append(found.storage[k].lower == 0)
        G = TABLE_4.storage_and_loss(2 * np.pi * found.frequency_hz)[0][k]
        means.append(np.log(found.storage_modulus_pa[k] / G) / found.storage_error[k])
        assert found.storage_error[k] > 0.9 * abs(OF_ALL[0])
    assert np.mean(none_needed) > 0.8
    assert 0.6 < np.sqrt(np.mean(np.square(means))) < 1.3


def test_a_repeatability_below_the_tolerances_is_found(law_of):
    """3 % from mount to mount, where every law by itself is known to 7 %."""
    rng, found = np.random.default_rng(10), []
    for _ in range(12):
        thicker, laws = rng.standard_normal(), []
        for _ in range(6):
            law = measured(rng, thicker)
            moved = np.exp(0.03 * rng.standard_normal() * np.array([1, 1, 0, 0]))
            laws.append(law_of(of_tolerances(law.with_values(law.values * moved))))
        size = spread_of(laws, "mounts").storage[3]
        found.append(size.lower < 0.03 < size.upper)
    assert np.mean(found) > 0.8


def test_the_command_says_what_being_one_specimen_would_tell(law_of, tmp_path, capsys):
    rng = np.random.default_rng(11)
    twice(law_of, rng)
    names = [str(tmp_path / f"{k}.json") for k in range(2)]
    assert run(["compare", *names]) == 0
    assert "--same-specimen then tells smaller differences apart" in capsys.readouterr().out
    assert run(["compare", *names, "--same-specimen", "--json", "-"]) == 0
    (pair,) = json.loads(capsys.readouterr().out)["pairs"]
    assert pair["alike"] == [THICK["name"]]
    other = of_tolerances(TABLE_4)
    other["adjusted"] = [{**THICK, "stated": 1.1}, *other["adjusted"][1:]]
    law_of(other)
    assert run(["compare", names[0], str(tmp_path / "2.json"), "--same-specimen"]) == 0
    assert "state core_thickness as different numbers" in " ".join(capsys.readouterr().out.split())
