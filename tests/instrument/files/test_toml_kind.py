"""Which file of this program one is, and what is said where another was expected."""

import pytest

from instrument.errors import BadInput
from instrument.files.new_file import TEMPLATES
from instrument.files.sensor_file import read_rig
from instrument.files.structure_file import read_structure
from instrument.files.toml_kind import kind_of_tables, kind_of_toml
from instrument.interchange.given import read_given

KINDS = {
    "plate": "a specimen",
    "beam": "a specimen",
    "shear-pair": "a specimen",
    "experiment": "an experiment",
    "experiment-beam": "an experiment",
    "rig": "a rig",
    "real-rig": "a rig",
    "sensors": "a list of sensors",
}


@pytest.mark.parametrize("name", TEMPLATES)
def test_every_template_is_known_for_what_it_is(name):
    assert kind_of_toml(TEMPLATES[name]) == KINDS[name]


def test_what_cannot_be_read_is_of_no_kind(tmp_path):
    assert kind_of_toml(tmp_path / "none.toml") == ""
    assert kind_of_tables({"title": "x"}) == ""


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("experiment", "an experiment, expected a specimen: it names specimen.toml"),
        ("rig", r"a rig, expected a specimen file \(viscorig new plate\)"),
        ("sensors", "a list of sensors, expected a specimen file"),
    ],
)
def test_another_file_is_no_specimen(name, said):
    with pytest.raises(BadInput, match=rf"\.toml: {said}"):
        read_structure(TEMPLATES[name])


def test_what_is_no_toml_is_no_specimen_by_its_name(tmp_path):
    path = tmp_path / "sweep.csv"
    path.write_text("frequency_hz,velocity_m_s\n20,0.001\n")
    with pytest.raises(BadInput, match="a table, expected a specimen file"):
        read_structure(path)
    with pytest.raises(BadInput, match="No such file"):
        read_structure(tmp_path / "none.csv")


def test_other_files_are_no_rig():
    with pytest.raises(BadInput, match="an experiment, expected a rig"):
        read_rig(TEMPLATES["experiment"])
    with pytest.raises(BadInput, match="a specimen, expected a rig, whose"):
        read_rig(TEMPLATES["plate"])


@pytest.mark.parametrize("name", ["plate", "rig", "experiment"])
@pytest.mark.parametrize("specimen", [None, TEMPLATES["plate"]])
def test_no_toml_file_is_data(name, specimen):
    with pytest.raises(BadInput, match=rf"\.toml: {KINDS[name]}, expected data: a sweep, or a session"):
        read_given(TEMPLATES[name], specimen, None)
