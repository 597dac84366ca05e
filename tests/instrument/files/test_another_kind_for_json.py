"""Another kind of file where a command's JSON is expected is called by its name."""

import json

import h5py
import pytest

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.file_kind import no_json
from instrument.files.hammer_file import read_hammer
from instrument.files.new_file import TEMPLATES
from instrument.material.found_law import read_law
from instrument.results.fit_file import read_fit

EXPECTED = "expected the JSON of 'viscorig identify'"
KINDS = {"plate": "a specimen", "experiment": "an experiment", "rig": "a rig"}


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("command", [["compare"], ["card", "--to", "csv"]])
def test_a_toml_file_is_no_law(capsys, name, command):
    path = str(TEMPLATES[name])
    assert run([*command, path, *(["other.json"] if command == ["compare"] else [])]) == 2
    assert f"{path}: {KINDS[name]}, {EXPECTED}" in capsys.readouterr().err


@pytest.mark.parametrize("read", [read_law, read_fit, read_hammer])
def test_a_table_is_none(tmp_path, read):
    path = tmp_path / "sweep.csv"
    path.write_text("frequency_hz,velocity_m_s\n20,0.001\n")
    with pytest.raises(BadInput, match=r"sweep\.csv: a table, expected the JSON of 'viscorig"):
        read(path)


def test_a_session_without_its_ending_is_told_of_it(tmp_path):
    path = tmp_path / "session.dat"
    with h5py.File(path, "w"):
        pass
    with pytest.raises(BadInput, match=r"an HDF5 file, expected text; a session's name ends in \.h5"):
        read_law(path)


@pytest.mark.parametrize("name", ["cut.json", "cut.txt"])
def test_json_that_is_cut_is_told_where(tmp_path, name):
    with pytest.raises(json.JSONDecodeError) as cut:
        json.loads('{\n"law"')
    assert no_json(tmp_path / name, cut.value).startswith("line 2: not JSON (")
