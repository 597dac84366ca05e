"""The published schemas: as the models are, and true of what the commands write."""

import json
import lzma
from pathlib import Path

import pytest
from found_law_cases import facts as law_facts
from json_schema import faults
from kept_numbers import KEPT, load
from paper_law import TABLE_4

from instrument.cli.main import run
from instrument.facts.schema import RESULTS, is_a_result, schema_of, write_schemas

PUBLISHED = Path(__file__).parents[3] / "docs" / "schema"
KEPT_RESULTS = {
    "identify-direct": "identify",
    "identify-paper": "identify",
    "identify-pointwise": "identify",
    "identify-session": "identify",
    "diagnose-nine-points": "diagnose",
    "diagnose-sweep": "diagnose",
    "damping": "damping",
}


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    path = tmp_path_factory.mktemp("session") / "small.h5"
    path.write_bytes(lzma.decompress((KEPT / "small.h5.xz").read_bytes()))
    return path


def said(capsys, *arguments):
    """A command's JSON."""
    status = run([*map(str, arguments), "--json", "-"])
    captured = capsys.readouterr()
    assert status == 0, captured.err
    found = json.loads(captured.out)
    # So that it may be written over.
    assert is_a_result(found)
    return found


def test_the_published_schemas_are_those_of_the_models(tmp_path):
    made = {path.name: path.read_text() for path in write_schemas(tmp_path)}
    assert {path.name: path.read_text() for path in PUBLISHED.iterdir()} == made, (
        "write them anew: python -m instrument.facts.schema docs/schema"
    )


@pytest.mark.parametrize("name", KEPT_RESULTS)
def test_a_result_is_as_its_schema_says(name):
    found, command = load(name)["facts"], KEPT_RESULTS[name]
    assert faults(found, schema_of(command)) == []
    assert not set(found) - set(RESULTS[command].model_fields)
    assert is_a_result(found)


@pytest.mark.parametrize(
    ("command", "arguments"),
    [
        ("card", ("a.json", "--to", "csv")),
        ("card", ("none.json", "--to", "json")),
        ("compare", ("a.json", "b.json")),
        ("compare", ("a.json", "elsewhere.json")),
        ("compare", ("a.json", "b.json", "c.json", "--spread")),
        ("new", ("rig",)),
    ],
)
def test_what_is_made_of_laws_is_as_its_schema_says(capsys, monkeypatch, tmp_path, command, arguments):
    made = {"a": {}, "b": {"low": 20.0}, "c": {"low": 16.0}, "elsewhere": {"low": 500.0, "high": 900.0}}
    for name, how in made.items():
        (tmp_path / f"{name}.json").write_text(json.dumps(law_facts(TABLE_4, **how)))
    unknown = law_facts(TABLE_4) | {"standard_errors": dict.fromkeys(TABLE_4.names)}
    (tmp_path / "none.json").write_text(json.dumps(unknown))
    monkeypatch.chdir(tmp_path)
    found = said(capsys, command, *arguments)
    assert faults(found, schema_of(command)) == []
    assert RESULTS[command].model_validate(found).as_json() == found


@pytest.mark.parametrize("name", KEPT_RESULTS)
def test_a_result_comes_back_from_json_to_the_bit(name):
    found = load(name)["facts"]
    again = RESULTS[KEPT_RESULTS[name]].model_validate(found).as_json()
    assert json.dumps(again) == json.dumps(found)


@pytest.mark.parametrize(
    ("command", "arguments"),
    [
        ("modes", ("coarse.toml", "--count", "3")),
        ("predict", ("coarse.toml", "--frequencies", "20,100")),
        ("predict", ("coarse.toml", "--frequencies", "20,100", "--fit", "fit.json")),
    ],
)
def test_what_a_model_says_is_as_its_schema_says(capsys, monkeypatch, tmp_path, command, arguments):
    (tmp_path / "coarse.toml").write_bytes((KEPT / "coarse.toml").read_bytes())
    (tmp_path / "fit.json").write_text(json.dumps(load("identify-direct")["facts"]))
    monkeypatch.chdir(tmp_path)
    assert faults(said(capsys, command, *arguments), schema_of(command)) == []


def test_what_is_written_of_a_session_is_as_its_schema_says(capsys, session, tmp_path):
    exported = said(capsys, "export", session, "--to", "uff", "--out", tmp_path)
    assert faults(exported, schema_of("export")) == []
    (sweep,) = (path for path in exported["files"] if path.endswith("-sweep.uff"))
    assert faults(said(capsys, "import", sweep, "--out", tmp_path / "a.csv"), schema_of("import")) == []


def test_an_experiment_is_checked_as_its_schema_says(capsys):
    experiment = KEPT / "run" / "small.toml"
    assert faults(said(capsys, "check", experiment), schema_of("check")) == []


def test_a_schema_refuses_what_is_not_a_result():
    found = load("identify-direct")["facts"]
    assert faults({**found, "parameters": None}, schema_of("identify")) == [
        "$.parameters: None, expected object"
    ]
    assert "missing" in faults({key: found[key] for key in found if key != "law"}, schema_of("identify"))[0]
    assert faults({**load("diagnose-sweep")["facts"], "verdict": "perhaps"}, schema_of("diagnose"))
