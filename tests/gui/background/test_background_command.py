"""A command in its own process, and what the window says of its end."""

import sys

import pytest
from data_folder import DATA

from gui.background.task import BackgroundCommand
from instrument.facts.identification import IdentificationResult
from instrument.facts.modes import ModesResult
from instrument.files.plausible import INSIST


def test_where_a_command_could_be_insisted_on_the_window_names_the_command_line(qtbot):
    refuses = f"import sys; sys.exit('viscorig: sweep.csv: in mm/s, expected m/s; {INSIST}')"
    program = sys.executable, "-c", refuses
    command = BackgroundCommand(["diagnose", "sweep.csv"], IdentificationResult, program=program)
    with qtbot.waitSignal(command.failed) as told:
        command.start()
    (said,) = told.args
    assert said.startswith("sweep.csv: in mm/s, expected m/s; correct it (")
    assert said.endswith("(a terminal goes on all the same: viscorig diagnose --force)")


def test_a_command_begins_by_itself_as_where_a_person_starts_it(qtbot, cold):
    command = BackgroundCommand(["modes", str(DATA / "numbers" / "coarse.toml"), "--count", "1"], ModesResult)
    with qtbot.waitSignal(command.done) as told:
        command.start()
    assert command._process.arguments()[:2] == ["-m", "instrument.cli"]
    assert told.args[0].modes[0].frequency_hz > 0


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux alone")
def test_the_tests_begin_it_with_everything_loaded(qtbot, monkeypatch):
    # As the command has it: what is forked has read it at its start.
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")
    command = BackgroundCommand(["modes", "none.toml"], ModesResult)
    with qtbot.waitSignal(command.failed) as told:
        command.start()
    assert "standing-in" in " ".join(command._process.arguments())
    assert told.args == ["none.toml: No such file or directory"]
