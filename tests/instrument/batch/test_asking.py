"""What a table of a batch may ask for, and what is asked about before anything is done."""

import re

import pytest

from instrument.batch.asking import tasks_of
from instrument.errors import BadInput


def asked(folder, text, specimen=None):
    (folder / "t.csv").write_text(text, encoding="utf-8")
    return tasks_of([folder / "t.csv"], specimen)


@pytest.mark.parametrize(
    ("name", "meant"), [("hamer", "hammer"), ("temperature", "temperature_c"), ("Hammer", "hammer")]
)
def test_a_misspelt_optional_column_is_named(tmp_path, name, meant):
    (tmp_path / "t.csv").write_text(f"data,{name},operator\na.csv,1,me\n")
    with pytest.raises(BadInput, match=f"column {name} is unknown, the nearest is {meant}"):
        tasks_of([tmp_path / "t.csv"], tmp_path / "b.toml")
    (tmp_path / "t.csv").write_text("data,operator\na.csv,me\n")
    assert tasks_of([tmp_path / "t.csv"], tmp_path / "b.toml")


def test_a_misspelt_column_of_specimens_is_named(tmp_path):
    (tmp_path / "t.csv").write_text("data,spec\na.csv,steel\n")
    with pytest.raises(BadInput, match="no specimen, the nearest is spec; expected it, or --specimen"):
        tasks_of([tmp_path / "t.csv"], None)
    (tmp_path / "t.csv").write_text("data,spec\na.h5,steel\n")
    assert tasks_of([tmp_path / "t.csv"], None)


@pytest.mark.parametrize("name", ["specimens", "Specimen", "plate"])
def test_specimens_that_a_table_names_are_not_passed_over_for_the_option_s(tmp_path, name):
    said = f"column {name} has b.toml, expected its name to be specimen"
    with pytest.raises(BadInput, match=said):
        asked(tmp_path, f"data,{name}\na.csv,b.toml\n", tmp_path / "c.toml")


@pytest.mark.parametrize("name", ["T", "temp_c", "Temperature [°C]", "temperature_f", "TEMPERATURE_C"])
def test_temperatures_by_another_name_are_not_passed_over(tmp_path, name):
    said = f"column {name} is unknown, the nearest is temperature_c"
    with pytest.raises(BadInput, match=re.escape(said)):
        asked(tmp_path, f"data,specimen,{name}\na.csv,b.toml,20\n")
    assert asked(tmp_path, f"data,specimen,temperature_c,{name}_2\na.csv,b.toml,20,21\n")
    assert asked(tmp_path, "data,specimen,template\na.csv,b.toml,20\n")


def test_a_temperature_below_the_absolute_zero_is_refused(tmp_path):
    with pytest.raises(BadInput, match=r"line 2: temperature_c = -300, expected more than -273\.15"):
        asked(tmp_path, "data,specimen,temperature_c\na.csv,b.toml,-300\n")


@pytest.mark.parametrize("heads", ["data;specimen;temperature_c", "file,spec,temperature_c"])
def test_a_list_of_files_that_is_not_written_as_ours_is_told_from_a_sweep(tmp_path, heads):
    separator = ";" if ";" in heads else ","
    path = tmp_path / "list.csv"
    path.write_text(f"{heads}\n{separator.join(['a.csv', 'a.toml', '21'])}\n", encoding="utf-8")
    near = "" if separator == ";" else ", the nearest is file"
    said = f"with the columns {heads}{near}: expected a column 'data', commas between its columns"
    for specimen in (None, tmp_path / "a.toml"):
        with pytest.raises(BadInput, match=re.escape(f"a list of files {said}")):
            tasks_of([path], specimen)


def test_a_file_that_is_not_there_is_said_to_be_so_before_its_specimen_is_missed(tmp_path):
    with pytest.raises(BadInput, match=r"gone\.csv: no such file"):
        tasks_of([tmp_path / "gone.csv"], None)
