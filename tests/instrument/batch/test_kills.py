"""A batch that is killed, or loses a worker, and what is left of it."""

import csv
import json
import os
import signal
import subprocess
import sys

import pytest
from batch_cases import CORRUPT, write_specimen, write_sweeps
from ending_jobs import end_always, end_once

from instrument.batch.asking import tasks_of
from instrument.batch.between import between_rows, marks_of
from instrument.batch.run import here, on_cluster, run_batch
from instrument.batch.table import write_tables
from instrument.batch.taking_part import repeats_among
from instrument.errors import BadInput
from instrument.processes.jobs import in_processes
from instrument.progress import LINES

COUNT = 12


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("killed")
    plate = write_specimen(folder)
    sweeps = write_sweeps(folder, plate, COUNT)
    sweeps[5].write_text(CORRUPT, encoding="utf-8")
    with run_batch(tasks_of(sweeps, plate), folder / "whole", here(1)) as rows:
        write(rows, folder / "whole")
    return sweeps, plate, (folder / "whole" / "batch.csv").read_bytes()


def write(rows, folder):
    """As the command does."""
    repeats = repeats_among(rows)
    write_tables(rows, folder, marks_of(between_rows(rows, repeats), repeats))


def keys_in(folder):
    text = (folder / "batch.jsonl").read_text(encoding="utf-8")
    return [json.loads(line)["key"] for line in text.splitlines(keepends=True) if line.endswith("\n")]


@pytest.mark.long
def test_killed_at_a_third_and_started_again_the_table_is_equal_to_the_bit(tmp_path, case):
    sweeps, plate, whole = case
    command = [sys.executable, "-m", "instrument.cli", "batch", *map(str, sweeps)]
    command += ["--specimen", str(plate), "--out", str(tmp_path), "--workers", "2"]
    environment = {**os.environ, LINES: "lines"}
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=environment) as first:
        for line in first.stderr:
            told = json.loads(line)
            if told["work"] == f"{COUNT} rows" and told["fraction"] >= 1 / 3:
                os.kill(first.pid, signal.SIGKILL)
                break
        first.stderr.read()
    assert first.returncode == -signal.SIGKILL
    before = keys_in(tmp_path)
    assert COUNT // 3 <= len(before) < COUNT
    assert subprocess.run(command, check=False, stdout=subprocess.DEVNULL).returncode == 0
    after = keys_in(tmp_path)
    assert len(after) == len(set(after)) == COUNT
    assert after[: len(before)] == before
    assert (tmp_path / "batch.csv").read_bytes() == whole


def test_a_killed_process_costs_its_jobs_a_second_go(tmp_path):
    kept = {}
    jobs = [(str(tmp_path), k) for k in range(5)]
    in_processes(end_once, jobs, 2, kept.__setitem__)
    assert kept == {job: job[1] for job in jobs}


def test_a_job_that_always_ends_its_process_is_given_up_alone(tmp_path):
    kept = {}
    in_processes(end_always, ["a", "b"], 2, kept.__setitem__, lost=lambda job: f"lost {job}")
    assert kept == {"a": "lost a", "b": "lost b"}


def start(*words, stderr=subprocess.DEVNULL):
    command = [sys.executable, "-m", "dask", *words]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=stderr, text=True)


@pytest.fixture
def cluster():
    """A scheduler and two workers, processes of their own: its address and the workers."""
    pytest.importorskip("distributed", reason="Dask is missing: pip install 'viscorig[cluster]'")
    words = ("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    started = [start(*words, stderr=subprocess.PIPE)]
    address = next(line.split()[-1] for line in started[0].stderr if "Scheduler at:" in line)
    for _ in range(2):
        started.append(start("worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"))
    yield address, started[1:]
    for process in reversed(started):
        process.kill()
        process.wait()
    started[0].stderr.close()


def test_a_killed_dask_worker_costs_its_tasks_only(tmp_path, case, cluster):
    sweeps, plate, whole = case
    address, workers = cluster
    seen = []

    class Reporting:
        def __init__(self, name):
            self.name = name

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def __call__(self, fraction):
            if "rows" in self.name and fraction >= 0.25 and not seen:
                seen.append(fraction)
                workers[0].kill()

    with run_batch(tasks_of(sweeps, plate), tmp_path, on_cluster(address), Reporting) as rows:
        write(rows, tmp_path)
    assert seen
    assert workers[0].wait() == -signal.SIGKILL
    assert (tmp_path / "batch.csv").read_bytes() == whole
    keys = keys_in(tmp_path)
    assert len(keys) == len(set(keys)) == COUNT


def test_no_scheduler_is_one_line(tmp_path, case, monkeypatch):
    pytest.importorskip("distributed", reason="Dask is missing: pip install 'viscorig[cluster]'")
    sweeps, plate, _ = case
    monkeypatch.setattr("instrument.batch.cluster._TIMEOUT_S", 1)
    with pytest.raises(BadInput, match="no Dask scheduler answers"):
        run_batch(tasks_of(sweeps[:1], plate), tmp_path, on_cluster("tcp://127.0.0.1:1"))


def test_a_column_is_one_law_parameter_and_its_error(case):
    _, _, whole = case
    header = next(csv.reader(whole.decode().splitlines()))
    assert header[header.index("tau_s") + 1] == "tau_standard_error_s"
