"""Rigs and experiments; the run itself is tested where it lives, and once more by an example."""

from types import SimpleNamespace

import pytest

import viscorig as vr
import viscorig.rig
from instrument.simulated_case import write_case


@pytest.fixture
def asked(monkeypatch, session_path):
    """What a run was asked for, in place of the run; it leaves a session."""
    seen = {}

    def run(experiment, out, parts, *, resume, progress):
        seen.update(experiment=experiment, out=out, parts=parts, resume=resume)
        return SimpleNamespace(session=session_path)

    monkeypatch.setattr(viscorig.rig, "run_experiment", run)
    return seen


def test_the_shipped_rig_is_simulated():
    rig = vr.Rig.from_file(vr.example_file("rig.toml"))
    assert rig.is_simulated
    assert rig.document.name == "simulated rig"


def test_a_rig_that_is_none_is_refused():
    with pytest.raises(vr.errors.BadInput, match="shaker"):
        vr.Rig.from_file(vr.example_file("specimen.toml"))


def test_an_experiment_runs_whole_on_the_rig_it_names(asked, tmp_path):
    path = write_case(tmp_path)
    session = vr.run(str(path), str(tmp_path))
    assert session.name == "zn1-20260401T080000Z"
    assert asked["parts"] == ("hammer", "sweep")
    assert asked["out"] == tmp_path
    assert asked["experiment"].rig_path == tmp_path / "rig.toml"


def test_a_rig_runs_an_experiment_in_place_of_the_rig_it_names(asked, tmp_path):
    path = write_case(tmp_path)
    other = vr.Rig.from_file(vr.example_file("rig.toml"))
    other.run(path, tmp_path, parts=["hammer"], resume=tmp_path / "x.running")
    assert asked["parts"] == ("hammer",)
    assert asked["resume"] == tmp_path / "x.running"
    assert asked["experiment"].rig_path == other.path
    assert asked["experiment"].rig == other.document


def test_an_experiment_that_is_not_there_is_named(tmp_path):
    with pytest.raises(vr.errors.BadInput, match=r"nowhere\.toml"):
        vr.run(tmp_path / "nowhere.toml")
