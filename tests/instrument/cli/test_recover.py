from sessions import configuration

from instrument.cli.main import run
from instrument.session.journal import SessionJournal


def begun(folder):
    SessionJournal(folder).begin(configuration())
    return folder


def test_the_folder_above_a_run_will_do(tmp_path, capsys):
    inside = begun(tmp_path / "one.running")
    assert run(["recover", str(tmp_path)]) == 2
    assert f"{inside}: nothing was completed" in capsys.readouterr().err


def test_of_two_runs_in_a_folder_one_has_to_be_named(tmp_path, capsys):
    for name in ("one", "two"):
        begun(tmp_path / f"{name}.running")
    assert run(["recover", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert "one.running, two.running" in said
    assert len(said.splitlines()) == 1
