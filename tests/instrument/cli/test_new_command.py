import pytest

from instrument.cli.main import run
from instrument.files.experiment_file import read_experiment
from instrument.files.new_file import TEMPLATES
from instrument.files.rig_file import RigDocument
from instrument.files.sensor_file import SensorsDocument
from instrument.files.structure_file import read_structure
from instrument.files.toml import read_document

READERS = {
    "experiment": read_experiment,
    "experiment-beam": read_experiment,
    "rig": lambda path: read_document(path, RigDocument),
    "sensors": lambda path: read_document(path, SensorsDocument),
    "real-rig": lambda path: read_document(path, RigDocument),
}


@pytest.mark.parametrize("kind", TEMPLATES)
def test_a_new_file_is_valid_as_it_stands(tmp_path, monkeypatch, kind):
    monkeypatch.chdir(tmp_path)
    assert run(["new", kind]) == 0
    READERS.get(kind, read_structure)(tmp_path / f"{kind}.toml")
    assert run(["new", kind, str(tmp_path / "other.toml")]) == 0
    assert (tmp_path / "other.toml").exists()


@pytest.mark.parametrize("kind", ["plate", "beam", "shear-pair"])
def test_a_new_specimen_can_be_predicted(tmp_path, kind):
    path = str(tmp_path / "s.toml")
    assert run(["new", kind, path]) == 0
    assert run(["modes", path, "--count", "1"]) == 0


def test_a_new_plate_stands_on_a_new_rig_and_a_new_experiment_goes(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for kind, name in (("plate", "specimen.toml"), ("rig", "rig.toml"), ("experiment", "experiment.toml")):
        assert run(["new", kind, name]) == 0
    assert run(["check", "experiment.toml"]) == 0
    assert "fault" not in capsys.readouterr().err


@pytest.mark.parametrize("kind", ["beam", "shear-pair"])
def test_a_new_beam_and_a_new_pair_have_an_experiment_that_goes(tmp_path, monkeypatch, capsys, kind):
    monkeypatch.chdir(tmp_path)
    for what, name in ((kind, "specimen.toml"), ("rig", "rig.toml"), ("experiment-beam", "experiment.toml")):
        assert run(["new", what, name]) == 0
    with open("rig.toml", "a") as rig:
        rig.write('specimen = "specimen.toml"\n')
    assert run(["check", "experiment.toml"]) == 0, capsys.readouterr().err


def test_a_file_that_is_there_is_kept(tmp_path, capsys):
    path = tmp_path / "mine.toml"
    path.write_text("mine")
    assert run(["new", "plate", str(path)]) == 2
    assert "there is a file already" in capsys.readouterr().err
    assert path.read_text() == "mine"
    assert run(["new", "bridge"]) == 2
