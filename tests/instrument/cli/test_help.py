"""The list of commands: at once, and true."""

import subprocess
import sys
from time import perf_counter

import click
import pytest

from instrument.cli.main import COMMANDS, viscorig
from instrument.cli.summaries import SUMMARIES

HELP = [sys.executable, "-m", "instrument.cli", "--help"]
AT_MOST, TRIES = 3.0, 5


@pytest.mark.parametrize("name", [*COMMANDS, "gui"])
def test_a_summary_is_what_the_command_says_of_itself(name):
    command = viscorig.get_command(click.Context(viscorig), name)
    assert SUMMARIES[name] == command.get_short_help_str(200)


def test_help_lists_every_command_and_loads_none():
    script = "import sys; from instrument.cli.main import run; run(['--help']); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    said, _, loaded = done.stdout.rpartition("\n  gui")
    assert all(f"\n  {name} " in said for name in COMMANDS)
    assert not {"numpy", "scipy", "h5py", "pydantic"} & set(loaded.split())


@pytest.mark.timing
def test_help_takes_at_most_three_times_as_long_as_importing_numpy():
    def least(command) -> float:
        took = []
        for _ in range(TRIES):
            began = perf_counter()
            subprocess.run(command, check=True, capture_output=True)
            took.append(perf_counter() - began)
        return min(took)

    assert least(HELP) < AT_MOST * least([sys.executable, "-c", "import numpy"])
