"""`viscorig run` and its like as a user calls them, on the simulated rig in its own process."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from by_hand.kill import campaign, write_case

from instrument.cli.main import run
from instrument.session.storage import SessionFile
from instrument.stream.raw import SessionEnded

pytestmark = pytest.mark.usefixtures("warm")

SEGMENTS = "[[sweep.segments]]\nlow_hz = 80.0\nhigh_hz = 290.0\npoints = 400\n"
STARTS_S = 60.0


def viscorig(*arguments, **options):
    command = [sys.executable, "-m", "instrument.cli", *(str(a) for a in arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)


def case(folder: Path) -> Path:
    experiment = write_case(folder, SEGMENTS)
    rig = folder / "rig.toml"
    rig.write_text(rig.read_text() + 'log = "rig.log"\n')
    return experiment


def wait_for_steps(folder: Path, process, least: int = 5) -> None:
    """Until so many parts are sealed."""
    deadline = time.monotonic() + STARTS_S
    while time.monotonic() < deadline and process.poll() is None:
        if sum(1 for _ in folder.glob("*.running/part-*.h5")) >= least:
            return
        time.sleep(0.005)
    raise AssertionError(f"no step measured: {process.communicate()}")


def rig_log(folder: Path) -> list[dict]:
    return [json.loads(line) for line in (folder / "rig.log").read_text().splitlines()]


def assert_silent(folder: Path, within_s: float, since: float) -> None:
    """In the rig's own record, soon enough."""
    deadline = time.monotonic() + within_s + 2
    while time.monotonic() < deadline and rig_log(folder)[-1]["what"] != "silent":
        time.sleep(0.01)
    log = rig_log(folder)
    assert log[-1]["what"] == "silent"
    assert log[-1]["drive_v"] == 0.0
    told = [e["wall_s"] for e in log[-3:] if e["wall_s"] is not None]
    assert max(told) - since < within_s


@pytest.mark.parametrize(
    ("number", "status", "said"),
    [
        (signal.SIGINT, 130, "stopped"),
        (signal.SIGHUP, 3, "the terminal was closed"),
        (signal.SIGTERM, 3, "terminated"),
    ],
)
def test_a_signal_silences_keeps_and_says_so_in_one_line(tmp_path, number, status, said):
    process = viscorig("sweep", case(tmp_path), "--out", tmp_path)
    wait_for_steps(tmp_path, process)
    since = time.monotonic()
    process.send_signal(number)
    _, error = process.communicate(timeout=30)
    assert process.returncode == status, error
    assert [line for line in error.splitlines() if line.startswith("viscorig:")] == [error.splitlines()[-1]]
    assert said in error
    assert "Traceback" not in error
    assert_silent(tmp_path, 2.0, since)
    (session,) = tmp_path.glob("*.h5")
    with SessionFile(session) as file:
        assert isinstance(list(file.events(with_samples=False))[-1], SessionEnded)


def test_after_a_kill_the_heartbeat_silences_the_shaker(tmp_path):
    process = viscorig("sweep", case(tmp_path), "--out", tmp_path)
    wait_for_steps(tmp_path, process)
    since = time.monotonic()
    process.kill()
    process.communicate()
    assert_silent(tmp_path, 2.5, since)


LIMITED = """
import resource
resource.setrlimit(resource.RLIMIT_FSIZE, (20 * 1024,) * 2)
from instrument.cli.main import main
main()
"""
"""Files may not grow beyond 20 kB: as far as the program can tell, the disk is full."""


def test_a_full_disk_stops_the_run_and_keeps_what_was_whole(tmp_path):
    experiment = case(tmp_path)
    words = [sys.executable, "-c", LIMITED, "sweep", str(experiment), "--out", str(tmp_path)]
    process = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
    _, error = process.communicate(timeout=60)
    assert process.returncode == 3, error
    assert "recording failed" in error
    assert "Traceback" not in error
    assert rig_log(tmp_path)[-1]["drive_v"] == 0.0


@pytest.mark.long
def test_nothing_complete_is_lost_by_kills_at_random_moments(tmp_path):
    """A short form of `python tests/by_hand/kill.py --kills 100`."""
    experiment = write_case(tmp_path, SEGMENTS)
    report = campaign(experiment, tmp_path / "out", kills=2, seed=7)
    assert report.kills >= 1
    assert report.lost == []
    assert report.unrecovered == 0
    assert report.repeated == []
    assert report.steps == 400


def test_simulate_stands_up_instruments_for_any_client(tmp_path):
    case(tmp_path)
    with viscorig("simulate", tmp_path / "rig.toml", stdin=subprocess.PIPE) as process:
        try:
            addresses = json.loads(process.stdout.readline())
            assert set(addresses) >= {"modbus_tcp", "modbus_rtu", "vibrometer_tty", "frontend_url"}
            assert addresses["modbus_tcp"].startswith("127.0.0.1:")
            _speak_to_vibrometer(addresses["vibrometer_tty"])
            if shutil.which("mbpoll"):
                _drive_by_mbpoll(addresses["modbus_tcp"])
        finally:
            process.send_signal(signal.SIGINT)
            try:
                assert process.wait(30) == 130
            finally:
                process.kill()
    if not shutil.which("mbpoll"):
        pytest.skip("mbpoll is not installed: the Modbus part was not shown")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_simulate_takes_its_instruments_down_however_it_is_ended(tmp_path, number):
    case(tmp_path)
    with viscorig("simulate", tmp_path / "rig.toml", stdin=subprocess.PIPE) as process:
        try:
            tty = Path(json.loads(process.stdout.readline())["vibrometer_tty"])
            assert tty.parent.exists()
            process.send_signal(number)
            assert process.wait(30) == 130
        finally:
            process.kill()
    assert not tty.parent.exists()


def _speak_to_vibrometer(path: str) -> None:
    """With nothing but the terminal's own calls."""
    handle = os.open(path, os.O_RDWR | os.O_NOCTTY)
    try:
        os.write(handle, b"Set,Interface,0,Echo,Off\r\nGet,VeloDec,1,Range\r\n")
        answer, deadline = b"", time.monotonic() + 5
        while b"mm/s/V" not in answer and time.monotonic() < deadline:
            answer += os.read(handle, 100)
        assert b"5mm/s/V" in answer
    finally:
        os.close(handle)


def _drive_by_mbpoll(address: str) -> None:
    """Run, command 50 Hz at 0.5 V, read it back; then no heartbeat: alarm, and no drive."""
    host, port = address.split(":")

    def mbpoll(*arguments: str) -> str:
        command = ["mbpoll", "-m", "tcp", "-p", port, "-0", "-1", "-q", *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    mbpoll("-r", "7", "-t", "4", host, "1")
    mbpoll("-r", "0", "-t", "4:float", "-B", host, "50.0", "0.5", "10.0")
    mbpoll("-r", "6", "-t", "4", host, "1")
    status = mbpoll("-r", "20", "-t", "4", "-c", "2", host)
    assert int(status.split("[20]:")[1].split()[0]) & 1
    deadline = time.monotonic() + 6
    while time.monotonic() < deadline:
        status = mbpoll("-r", "20", "-t", "4", "-c", "2", host)
        if int(status.split("[21]:")[1].split()[0]) == 1:
            break
        time.sleep(0.1)
    assert int(status.split("[21]:")[1].split()[0]) == 1
    assert int(status.split("[20]:")[1].split()[0]) & 1 == 0


def of_a_process(*words):
    process = viscorig(*words)
    _, error = process.communicate(timeout=30)
    return process.returncode, error


@pytest.mark.parametrize("command", ["run", "hammer", "sweep", "check"])
def test_a_missing_experiment_is_one_line_and_exit_2(tmp_path, capsys, cold, command):
    words = (command, str(tmp_path / "absent.toml"))
    status, error = of_a_process(*words) if command == "run" else (run(words), capsys.readouterr().err)
    assert status == 2
    assert len([line for line in error.splitlines() if line.startswith("viscorig:")]) == 1
    assert "Traceback" not in error
