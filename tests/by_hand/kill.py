"""SIGKILL at random moments of one sweep, carried on after each: is anything complete ever lost?

    python tests/by_hand/kill.py --kills 100

Every time the process dies, what its journal had named until then is compared with what is recovered.
"""

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

from instrument.session.journal import JOURNAL
from instrument.session.storage import SessionFile
from instrument.simulated_case import FILES, case_file
from instrument.stream.derived import PointMeasured

STARTS_S = 60.0


@dataclass
class Report:
    """What the kills did."""

    kills: int = 0
    lost: list[int] = field(default_factory=list)
    """Steps that the journal had named and a recovery lacked."""
    unrecovered: int = 0
    steps: int = 0
    """Of the sweep when it was whole."""
    repeated: list[float] = field(default_factory=list)
    """Frequencies measured twice although the first time was complete."""
    finished: bool = False


def write_case(folder: Path, segments: str) -> Path:
    """The simulated case without hammer, calibration and sentinel, with other segments."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in FILES:
        (folder / name).write_text(case_file(name).read_text())
    experiment = folder / "experiment.toml"
    experiment.write_text(
        'specimen = "specimen.toml"\nrig = "rig.toml"\n[sweep]\nsentinel = false\ncalibration = false\n'
        + segments
    )
    return experiment


def campaign(experiment: Path, out: Path, kills: int, seed: int) -> Report:
    """Kill, recover, carry on, until the sweep is whole or the kills are used up; then let it finish."""
    chance, report, running = random.Random(seed), Report(), None
    while report.kills < kills:
        named = _run_and_kill(experiment, out, running, chance.uniform(0.0, 0.8))
        running = next(out.glob("*.running"), None)
        if named is None:
            break
        report.kills += 1
        _recover(running, named, report)
    if running is not None and running.exists():
        _viscorig("sweep", experiment, "--out", out, "--resume", running).check_returncode()
    _judge(next(out.glob("*.h5")), report)
    return report


def _run_and_kill(experiment: Path, out: Path, running: Path | None, delay_s: float) -> list[int] | None:
    """Steps the journal named when the process died; None where it had finished before."""
    resume = ["--resume", str(running)] if running is not None else []
    command = [sys.executable, "-m", "instrument.cli", "sweep", str(experiment), "--out", str(out), *resume]
    before = _named(running)
    process = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True)
    # Random moments of the measurement, not of the start: from the first new step on.
    deadline = time.monotonic() + STARTS_S
    while process.poll() is None and time.monotonic() < deadline:
        if len(_named(next(out.glob("*.running"), None))) > len(before):
            break
        time.sleep(0.002)
    try:
        process.wait(delay_s)
    except subprocess.TimeoutExpired:
        named = _named(next(out.glob("*.running"), None))
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return named
    _, said = process.communicate()
    if process.returncode:
        raise RuntimeError(f"exit {process.returncode}: {said.decode()}")
    return None


def _recover(running: Path | None, named: list[int], report: Report) -> None:
    done = _viscorig("recover", running, "--json", "-") if running is not None else None
    if done is None or done.returncode:
        report.unrecovered += 1
        return
    facts = json.loads(done.stdout)
    report.lost += sorted(set(named) - set(facts["steps"]))
    Path(facts["session"]).unlink()


def _judge(session: Path, report: Report) -> None:
    with SessionFile(session) as file:
        points = [e for e in file.events(with_samples=False) if isinstance(e, PointMeasured)]
    frequencies = [p.frequency_hz for p in points]
    report.steps = len(frequencies)
    report.repeated = sorted({f for f in frequencies if frequencies.count(f) > 1})
    report.finished = True


def _named(running: Path | None) -> list[int]:
    if running is None or not (running / JOURNAL).exists():
        return []
    # The lines as they stand, a torn last one left out: looked at far too often for checksums.
    lines = (running / JOURNAL).read_text(errors="replace").split("\n")[:-1]
    return [step for line in lines for step in json.loads(line)["steps"]]


def _viscorig(*arguments: object) -> subprocess.CompletedProcess[bytes]:
    command = [sys.executable, "-m", "instrument.cli", *(str(a) for a in arguments)]
    return subprocess.run(command, capture_output=True, check=False)


def main() -> None:
    """Run the campaign and print its report."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--kills", type=int, default=100)
    options.add_argument("--points", type=int, default=1000, help="of each of four segments")
    options.add_argument("--seed", type=int, default=0)
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        segments = "".join(
            f"[[sweep.segments]]\nlow_hz = {low}.0\nhigh_hz = {low + 40}.0\npoints = {given.points}\n"
            for low in (80, 130, 180, 230)
        )
        experiment = write_case(Path(folder), segments)
        print(campaign(experiment, Path(folder) / "out", given.kills, given.seed))


if __name__ == "__main__":
    main()
