"""A command in its own process, and what the window says of its end."""

from gui.background_task import BackgroundCommand
from instrument.facts.identification import IdentificationResult
from instrument.files.plausible import INSIST


def test_where_a_command_could_be_insisted_on_the_window_names_the_command_line(qtbot, monkeypatch):
    command = BackgroundCommand(["diagnose", "sweep.csv"], IdentificationResult)
    monkeypatch.setattr(command, "_hear", lambda: None)
    command._said = [f"viscorig: sweep.csv: in mm/s, expected m/s; {INSIST}"]
    with qtbot.waitSignal(command.failed) as told:
        command._finished(2)
    assert told.args == ["sweep.csv: in mm/s, expected m/s; 'viscorig diagnose --force' goes on all the same"]
