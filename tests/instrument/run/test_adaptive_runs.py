"""A sweep that chooses its own steps on the simulated rig: killed, broken off, carried on, replayed."""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import quick_run
from run_at_point import RunAtPoint

from instrument.errors import RigStopped
from instrument.run.control import RunControl
from instrument.run.experiment import run_experiment
from instrument.run.replay import replay
from instrument.session.configuration import read_whole_experiment
from instrument.session.journal import JOURNAL
from instrument.session.storage import SessionFile
from instrument.simulated_case import write_case
from instrument.stream.derived import StepsChosen

ADAPTIVE = """
specimen = "specimen.toml"
rig = "rig.toml"
[sweep]
plan = "adaptive"
sentinel = false
calibration = { frequencies_hz = [20.0, 40.0, 60.0] }
settle = { tolerance_percent = 0.001 }
[sweep.adaptive]
band_hz = [13.5, 60.0]
target_percent = 1.0
"""
STARTS_S = 90.0


def adaptive_case(folder: Path) -> Path:
    """The first two resonances, without sensor noise: one run reads what another does.

    A band in which no candidate is nearly as good as the best: of two that are, what is left of transients
    would say which comes first, and the sweep may be two steps longer (a band from 14 Hz).
    """
    path = write_case(folder)
    path.write_text(ADAPTIVE)
    rig = folder / "rig.toml"
    rig.write_text(rig.read_text() + "noise = 0.0\n")
    return path


def steps_of(points):
    return [p.frequency_hz for p in points if p.purpose == "step"]


def sealed(folder: Path) -> int:
    journal = next(folder.glob(f"*.running/{JOURNAL}"), None)
    return journal.read_text(errors="replace").count("\n") if journal is not None else 0


def run_and_kill(experiment: Path, out: Path, after: int, delay_s: float) -> bool:
    """Kill it so long after so many further parts are sealed; whether it was still running."""
    resume = [str(f) for f in out.glob("*.running")]
    command = [sys.executable, quick_run.__file__, str(experiment), str(out), *resume]
    wanted, deadline = sealed(out) + after, time.monotonic() + STARTS_S
    with subprocess.Popen(command, start_new_session=True) as process:
        while process.poll() is None and time.monotonic() < deadline and sealed(out) < wanted:
            time.sleep(0.002)
        try:
            process.wait(delay_s)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
        return process.wait() == -signal.SIGKILL


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Never stopped."""
    folder = tmp_path_factory.mktemp("whole")
    experiment = read_whole_experiment(adaptive_case(folder))
    return run_experiment(experiment, folder, ("sweep",), fit=quick_run.no_fit)


def judge(session: Path, whole) -> None:
    """The same steps in the same order, none twice, every choice there and made again to the bit.

    Where sampling begins anew readings differ by what is left of transients, and candidates by a mHz.
    """
    with SessionFile(session) as file:
        choices = {e.number: e for e in file.events(with_samples=False) if isinstance(e, StepsChosen)}
        again = replay(file, fit=quick_run.no_fit)
    assert again.differences == []
    assert steps_of(again.points) == pytest.approx(steps_of(whole.points), abs=0.02)
    assert sorted(choices) == list(range(1, len(choices) + 1))
    assert choices[len(choices)].ended


@pytest.mark.long
def test_killed_again_and_again_it_goes_on_as_if_it_had_never_been_stopped(tmp_path, whole):
    experiment, chance = adaptive_case(tmp_path), random.Random(5)
    out, kills = tmp_path / "out", 0
    for after in (5, 8, 7, 2, 3):
        kills += run_and_kill(experiment, out, after, chance.uniform(0.0, 0.4))
    assert kills >= 3
    if next(out.glob("*.running"), None) is not None:
        assert not run_and_kill(experiment, out, 10_000, STARTS_S)
    judge(next(out.glob("*.h5")), whole)


@pytest.mark.long
@pytest.mark.parametrize("after", [4, 14])
def test_broken_off_it_goes_on_as_if_it_had_never_been_stopped(tmp_path, whole, after):
    experiment, control = read_whole_experiment(adaptive_case(tmp_path)), RunControl()
    enough = RunAtPoint(after, lambda: control.abort("broken off"))
    with pytest.raises(RigStopped, match="broken off"):
        run_experiment(
            experiment, tmp_path, ("sweep",), fit=quick_run.no_fit, control=control, companion=enough
        )
    (running,) = tmp_path.glob("*.running")
    run_experiment(experiment, tmp_path, ("sweep",), fit=quick_run.no_fit, resume=running)
    judge(next(tmp_path.glob("*.h5")), whole)
