import json
from types import SimpleNamespace

import pytest
from sessions import block, configuration, point

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.session.journal import SessionJournal
from instrument.session.recorder import Recorder
from instrument.stream.raw import AcquisitionBegan


def begun(folder, made=None):
    SessionJournal(folder).begin(made or configuration())
    return folder


def test_the_folder_above_a_run_will_do(tmp_path, capsys):
    inside = begun(tmp_path / "one.running")
    assert run(["recover", str(tmp_path)]) == 2
    assert f"{inside}: nothing was completed" in capsys.readouterr().err


def test_a_run_that_still_goes_on_is_left_alone(tmp_path, capsys):
    folder = recorded(tmp_path / "one.running", 2)
    owner = SessionJournal(folder)
    owner.lock()
    try:
        assert run(["recover", str(folder)]) == 2
        assert f"{folder}: another run goes on in it" in capsys.readouterr().err
        assert not (tmp_path / "one.h5").exists()
        with pytest.raises(BadInput, match="another run goes on in it"):
            SessionJournal(folder).begin(configuration())
    finally:
        owner.unlock()
    assert run(["recover", str(folder)]) == 0
    with pytest.raises(BadInput, match="exists already: --resume it"):
        SessionJournal(folder).begin(configuration())


@pytest.mark.parametrize(("command", "said"), [("sweep", "sweep"), ("run", "run"), ("", "run")])
def test_the_command_that_was_broken_off_is_named(tmp_path, capsys, command, said):
    made = configuration()
    made = made.model_copy(
        update={"command": command, "experiment": made.experiment.model_copy(update={"hammer": None})}
    )
    folder = recorded(tmp_path / "one.running", 1, made)
    assert run(["recover", str(folder)]) == 0
    assert f"to go on: viscorig {said} EXPERIMENT.toml --resume {folder}" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("file", "said"),
    [("plate 2.toml", "'plate 2.toml'"), ("a.toml", "a.toml"), ("../a.toml", "EXPERIMENT.toml")],
)
def test_the_experiment_s_file_is_named_where_the_folder_knows_it(tmp_path, capsys, file, said):
    made = configuration().model_copy(update={"experiment_file": file})
    folder = recorded(tmp_path / "one.running", 1, made)
    assert run(["recover", str(folder)]) == 0
    assert f" {said} --resume {folder}" in capsys.readouterr().out


def test_of_two_runs_in_a_folder_one_has_to_be_named(tmp_path, capsys):
    for name in ("one", "two"):
        begun(tmp_path / f"{name}.running")
    assert run(["recover", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert "one.running, two.running" in said
    assert len(said.splitlines()) == 1


def recorded(folder, steps, made=None):
    """A run of some steps, a part each."""
    journal = SessionJournal(begun(folder, made))
    with Recorder(journal, []) as recorder:
        recorder.record(AcquisitionBegan(1, "sweep", 8192.0, ("base", "velocity")))
        for k in range(steps):
            recorder.record(block(8 * k))
            recorder.record(point(k + 1))
    recorder.check()
    return folder


def test_what_is_whole_is_put_together_and_nothing_is_said_to_be_lost(tmp_path, capsys):
    folder = recorded(tmp_path / "one.running", 3)
    assert run(["recover", str(folder)]) == 0
    said = capsys.readouterr().out
    assert "3 completed steps in 3 parts" in said
    assert "lost" not in said


def test_what_a_damaged_part_takes_with_it_is_said(tmp_path, capsys):
    folder = recorded(tmp_path / "one.running", 4)
    with (folder / "part-000002.h5").open("ab") as file:
        file.write(b"x")
    written = tmp_path / "recover.json"
    assert run(["recover", str(folder), "--json", str(written)]) == 0
    said = capsys.readouterr().out
    assert "1 completed steps in 1 parts" in said
    assert "lost: part 2 (part-000002.h5 is damaged) and 2 parts after it, with 3 completed steps" in said
    assert "copy the folder first" in said
    found = json.loads(written.read_text())
    assert (found["steps"], found["lost_parts"], found["lost_steps"]) == ([1], 3, [2, 3, 4])


def test_where_the_first_part_is_damaged_that_is_why_there_is_no_session(tmp_path, capsys):
    folder = recorded(tmp_path / "one.running", 2)
    (folder / "part-000001.h5").unlink()
    assert run(["recover", str(folder)]) == 2
    assert "part-000001.h5 is missing" in capsys.readouterr().err


def test_a_session_that_holds_more_than_the_folder_is_not_written_over(tmp_path, capsys):
    folder = recorded(tmp_path / "one.running", 3)
    assert run(["recover", str(folder)]) == 0
    before = (tmp_path / "one.h5").read_bytes()
    (folder / "part-000002.h5").unlink()
    capsys.readouterr()
    assert run(["recover", str(folder)]) == 2
    assert "one.h5: holds 3 parts, the folder only 1: move it away first" in capsys.readouterr().err
    assert (tmp_path / "one.h5").read_bytes() == before


def test_a_file_is_not_said_to_be_missing(tmp_path, capsys):
    (tmp_path / "one.h5").touch()
    assert run(["recover", str(tmp_path / "one.h5")]) == 2
    assert "one.h5: a file, expected the folder of a run" in capsys.readouterr().err


def test_a_runs_folder_in_the_place_of_its_session_leads_to_recover(tmp_path, capsys):
    folder = recorded(tmp_path / "one.running", 1)
    assert run(["replay", str(folder)]) == 2
    assert f"viscorig recover {folder} puts its session together" in capsys.readouterr().err


def test_on_a_full_disk_it_says_what_to_do(tmp_path, capsys, monkeypatch):
    folder = recorded(tmp_path / "one.running", 1)
    monkeypatch.setattr("shutil.disk_usage", lambda _: SimpleNamespace(free=1e3))
    assert run(["recover", str(folder)]) == 2
    said = capsys.readouterr().err
    assert "disk full: 0 MB free" in said
    assert f"make room, or copy {folder} to another disk and recover it there" in said
