"""What a file is that was named in the place of another."""

import json

import pytest

from instrument.errors import BadInput
from instrument.files.dma_file import read_dma
from instrument.files.file_kind import HAMMER_TEST, kind_of_facts, kind_of_file, refuse_another
from instrument.files.new_file import TEMPLATES
from instrument.files.sensor_file import read_sensors
from instrument.interchange.given import read_given
from instrument.interchange.importing import import_file
from instrument.material.found_law import read_law
from instrument.paper_case import case_file


@pytest.mark.parametrize(
    ("name", "content", "kind"),
    [
        ("a.csv", "x", "a table"),
        ("a.h5", "x", "a session"),
        ("a.txt", "x", ""),
        ("a.toml", "x", ""),
        ("a.toml", "[plate]\nlength_mm = 1\n", "a specimen"),
        ("a.json", "{", "JSON"),
        ("a.json", '{"a": 1}', "JSON"),
        ("a.json", "[" * 10_000, "JSON"),
        ("a.json", '{"modes": [], "hits": []}', HAMMER_TEST),
        ("a.json", '{"words": "", "standing": "diagnosed", "law": []}', "a run's result, in short"),
        ("a.json", '{"verdict": "none", "after": {}}', "a diagnosis ('viscorig diagnose')"),
    ],
)
def test_a_file_is_known_by_what_it_holds_or_its_ending(tmp_path, name, content, kind):
    (tmp_path / name).write_text(content)
    assert kind_of_file(tmp_path / name) == kind


def test_a_folder_is_one_whatever_its_name_and_nothing_is_of_no_kind(tmp_path):
    (tmp_path / "a.csv").mkdir()
    assert kind_of_file(tmp_path / "a.csv") == "a folder"
    assert kind_of_file(tmp_path / "none.csv") == ""
    assert kind_of_facts([1]) == ""


def test_only_what_is_known_to_be_another_is_refused(tmp_path):
    (tmp_path / "a.csv").write_text("x")
    refuse_another(tmp_path / "a.csv", "a table", "nothing")
    refuse_another(tmp_path / "none.csv", "a rig", "nothing")
    refuse_another(tmp_path / "a.csv", ("a session", "a table"), "nothing")
    with pytest.raises(BadInput, match=r"a\.csv: a table, expected a rig"):
        refuse_another(tmp_path / "a.csv", "a rig", "a rig")


def test_a_hammer_test_for_data_is_told_its_option(tmp_path):
    path = tmp_path / "damping.json"
    path.write_text(json.dumps({"modes": [], "hits": []}))
    with pytest.raises(BadInput, match=r"expected data: a sweep, or a session; it goes with --hammer"):
        read_given(path, case_file("zn1.toml"), None)


def test_a_specimen_is_no_table_of_moduli_and_a_rig_no_list_of_sensors():
    with pytest.raises(BadInput, match=r"a specimen, expected a table of moduli over frequency"):
        read_dma(TEMPLATES["plate"], 0.5)
    with pytest.raises(BadInput, match=r"a rig, expected a list of sensors"):
        read_sensors(TEMPLATES["rig"])


def test_the_short_result_of_a_run_is_said_to_be_one_where_a_law_is_expected(tmp_path):
    path = tmp_path / "run-result.json"
    path.write_text('{"words": "", "standing": "diagnosed"}')
    with pytest.raises(BadInput, match=r"a run's result, in short, expected the JSON of 'viscorig identify'"):
        read_law(path)


def test_a_table_beside_which_it_would_be_imported_gets_another_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    table = "Frequency [Hz];Velocity real [m/s];Velocity imag [m/s]\n" + "".join(
        f"{f};0,00{f};0,001\n" for f in range(20, 40)
    )
    (tmp_path / "own.csv").write_text(table)
    found = import_file((tmp_path / "own.csv").relative_to(tmp_path), None)
    assert [path.name for path in found.files] == ["own-imported.csv"]
    assert (tmp_path / "own.csv").read_text() == table
    with pytest.raises(BadInput, match="would be written over"):
        import_file(tmp_path / "own.csv", tmp_path / "own.csv")
