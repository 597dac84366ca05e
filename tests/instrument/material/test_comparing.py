"""Laws compared: what noise leaves is no difference, what is one is found where it is."""

import json

import numpy as np
import pytest
from batch_cases import write_specimen, write_sweeps
from diagnosed_session import diagnosed_session
from found_law_cases import ERRORS, HIGH, LOW, facts
from paper_law import TABLE_4

from fitting.numerics.chances import Z_95
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.material.comparing import compare
from instrument.material.found_law import read_law
from instrument.results.fit_file import read_fit


@pytest.fixture
def law_of(tmp_path):
    def made(law, name="a.json", **how):
        path = tmp_path / name
        path.write_text(json.dumps(facts(law, **how)), encoding="utf-8")
        return read_law(path)

    return made


def drawn(rng):
    return TABLE_4.with_values(TABLE_4.values * np.exp(ERRORS * rng.standard_normal(4)))


def test_a_law_agrees_with_itself(law_of):
    c = compare(law_of(TABLE_4), law_of(TABLE_4))
    assert c.covariance == "posterior"
    assert c.p_value > 0.99
    assert c.differs is False
    assert c.where(c.storage_z) == []


def test_one_in_twenty_differs_by_chance(law_of):
    rng = np.random.default_rng(3)
    p = [compare(law_of(drawn(rng)), law_of(drawn(rng))).p_value for _ in range(200)]
    assert 0.01 <= np.mean(np.array(p) < 0.05) <= 0.10
    assert 0.35 < np.median(p) < 0.7


def test_what_would_be_seen_is_beyond_the_joint_error(law_of):
    c = compare(law_of(TABLE_4), law_of(TABLE_4))
    at, storage, eta = c.would_be_seen
    assert LOW < at < HIGH
    middle = len(c.frequency_hz) // 2
    assert storage == pytest.approx(Z_95 * c.joint_error[middle])
    assert eta == pytest.approx(Z_95 * c.joint_error[len(c.frequency_hz) + middle])
    assert compare(law_of(TABLE_4, high=50.0), law_of(TABLE_4, low=60.0)).would_be_seen is None


def test_a_stiffer_core_is_found_where_it_is_stiffer(law_of):
    values = TABLE_4.values * np.array([1.3, 1.0, 1.0, 1.0])
    c = compare(law_of(TABLE_4), law_of(TABLE_4.with_values(values)))
    assert c.differs is True
    ((low, high),) = c.where(c.storage_z)
    assert low == pytest.approx(LOW)
    assert high < HIGH
    assert np.abs(c.storage_z[0]) > Z_95
    assert c.storage_difference[0] > c.storage_difference[-1] > -0.01


def test_without_the_fits_covariance_errors_go_together_over_a_reach(law_of):
    stiff = TABLE_4.with_values(TABLE_4.values * np.array([1.5, 1.5, 1, 1]))
    same, other = law_of(TABLE_4, posterior=False), law_of(stiff)
    c = compare(same, other)
    assert c.covariance == "standard errors"
    assert c.differs is True
    assert compare(same, same).differs is False


def test_without_errors_nothing_is_told(law_of):
    c = compare(law_of(TABLE_4, errors=np.full(4, np.nan), posterior=False), law_of(TABLE_4))
    assert c.differs is None


def test_laws_without_a_common_band_cannot_be_told_apart(law_of):
    c = compare(law_of(TABLE_4, high=50.0), law_of(TABLE_4, low=60.0))
    assert len(c.frequency_hz) == 0
    assert c.differs is None


def test_the_command_says_each_pair(tmp_path, capsys):
    plate = write_specimen(tmp_path)
    names = []
    for k, sweep in enumerate(write_sweeps(tmp_path, plate, 2, points=(25,))):
        names.append(str(tmp_path / f"{k}.json"))
        assert run(["identify", str(sweep), "--specimen", str(plate), "--json", names[-1]]) == 0
    names.append(str(diagnosed_session(tmp_path)))
    capsys.readouterr()
    assert run(["compare", *names, "--json", "-"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert len(said["pairs"]) == 3
    first = said["pairs"][0]
    assert first["covariance"] == "posterior"
    assert first["p_value"] is not None
    assert len(first["frequencies"]) == 41
    assert run(["compare", *names]) == 0
    assert "joint standard errors" in capsys.readouterr().out


def test_laws_of_unlike_temperatures_are_said_to_be(tmp_path, capsys):
    names = []
    for warm in (20.0, 20.5, 35.0):
        names.append(str(tmp_path / f"{warm:g}.json"))
        (tmp_path / names[-1]).write_text(json.dumps(facts(TABLE_4) | {"temperature_c": warm}))
    assert run(["compare", *names]) == 0
    said = [line for line in capsys.readouterr().out.splitlines() if "degC" in line]
    assert said == [
        "20.json and 35.json: of 20 and 35 degC, which alone makes laws differ",
        "20.5.json and 35.json: of 20.5 and 35 degC, which alone makes laws differ",
    ]


def test_a_temperature_in_kelvin_and_an_unknown_verdict_are_said(tmp_path, capsys):
    diagnosed = {"verdict": "unknown", "after": facts(TABLE_4)}
    for name, found in (("a.json", diagnosed), ("b.json", facts(TABLE_4) | {"temperature_c": 294.6})):
        (tmp_path / name).write_text(json.dumps(found))
    assert run(["compare", str(tmp_path / "a.json"), str(tmp_path / "b.json")]) == 0
    said = capsys.readouterr().out
    assert "a.json: verdict unknown: this law may be biased" in said
    assert "b.json: temperature_c = 294.6: is it in K?" in said


def test_a_law_that_is_a_mixture_of_several_is_said_to_be(tmp_path, capsys):
    found = {
        "verdict": "ambiguous",
        "after": facts(TABLE_4),
        "effects": [{"name": "added_mass"}],
        "equivalent": {"added_mass": ["added_mass", "tip_magnet"]},
    }
    (tmp_path / "a.json").write_text(json.dumps(found))
    (tmp_path / "b.json").write_text(json.dumps(facts(TABLE_4)))
    assert run(["compare", str(tmp_path / "a.json"), str(tmp_path / "b.json")]) == 0
    assert (
        "a.json: verdict ambiguous (added_mass, not told from tip_magnet): its band"
        in capsys.readouterr().out
    )


_SOFTER = [{**row, "storage_modulus_pa": 0.5 * row["storage_modulus_pa"]} for row in facts(TABLE_4)["law"]]
_NO_LAW = {"verdict": "effect", "after": facts(TABLE_4) | {"law": []}}


@pytest.mark.parametrize(
    "changed",
    [
        {"temperature_c": -300.0},
        {"temperature_c": float("inf")},
        {"law": facts(TABLE_4)["law"] + _SOFTER},
        {"diagnose": _NO_LAW},
        {"law": [row | {"storage_modulus_pa": 1e-308} for row in facts(TABLE_4)["law"]]},
    ],
    ids=[
        "below absolute zero",
        "no temperature",
        "two moduli at each frequency",
        "a diagnosis cut off",
        "no modulus",
    ],
)
def test_a_law_that_contradicts_itself_is_refused(tmp_path, changed):
    path = tmp_path / "a.json"
    path.write_text(json.dumps(facts(TABLE_4) | changed))
    with pytest.raises(BadInput, match=r"a\.json: expected the JSON of 'viscorig identify'"):
        read_law(path)


def test_nothing_is_printed_where_the_mounts_are_refused(tmp_path, capsys):
    (tmp_path / "a.json").write_text(json.dumps(facts(TABLE_4)))
    assert run(["compare", "--remounts", *[str(tmp_path / "a.json")] * 2]) == 2
    assert capsys.readouterr().out == ""


def test_one_file_is_not_enough(tmp_path, capsys):
    assert run(["compare", str(tmp_path / "a.json")]) == 2
    assert "two or more" in capsys.readouterr().err


def test_a_file_that_is_not_json_is_told_what_is_expected(tmp_path):
    (tmp_path / "a.json").write_text("{")
    for read in (read_law, read_fit):
        with pytest.raises(BadInput, match=r"not JSON \(.*\), expected the JSON of 'viscorig identify'"):
            read(tmp_path / "a.json")
