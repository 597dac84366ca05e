"""`python -m campaign`: its help, and refusals in a line under its own name."""

import subprocess
import sys

from campaign.__main__ import campaign
from instrument.cli.main import BAD_INPUT, BY_NAME, run


def test_it_is_no_command_of_the_program():
    assert "campaign" not in BY_NAME


def test_a_refusal_is_a_line_and_a_status(tmp_path, capsys):
    asked = ["plates", str(tmp_path), "--law-alone", "--shows", "20"]
    assert run(asked, campaign, "python -m campaign") == BAD_INPUT
    assert capsys.readouterr().err.splitlines() == [
        "campaign: --shows is of diagnoses, expected no --law-alone beside it"
    ]


def test_it_runs_as_a_module():
    done = subprocess.run(
        [sys.executable, "-m", "campaign", "-h"], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("Usage: python -m campaign ")
    assert all(f"\n  {name} " in done.stdout for name in ("plant", "plates", "beams", "apart"))
