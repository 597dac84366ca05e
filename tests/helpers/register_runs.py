"""Runs in a window to which something happens, looked at from begin to end."""

import time
from pathlib import Path

import httpx
from engine_cases import LONG, drive_v, engine_rig
from PySide6.QtWidgets import QApplication
from register_looks import RegisterLooks
from window_runs import run_until_driven

PATIENCE_S = 120.0


class Turns:
    """What `run_until_driven` asks of a test's bot."""

    def waitUntil(self, until, timeout=1e3 * PATIENCE_S):
        end = time.monotonic() + timeout / 1e3
        while not until():
            if time.monotonic() > end:
                raise TimeoutError
            QApplication.processEvents()
            time.sleep(0.001)

    def wait(self, seconds):
        """Let the window live so long."""
        end = time.monotonic() + seconds
        self.waitUntil(lambda: time.monotonic() > end)


def _hold_and_stop(turns, window, rig, seconds):
    window.controller.commands.hold()
    turns.waitUntil(lambda: window.controller.state.run.state == "held" and drive_v(rig) == 0)
    turns.wait(seconds)
    window.controller.commands.hold()
    turns.waitUntil(lambda: drive_v(rig) > 0.05)
    turns.wait(seconds)


def _front_end_hangs(turns, window, rig, seconds):
    httpx.put(f"{rig.front_end.url}/simulated/hang", trust_env=False).raise_for_status()
    turns.wait(seconds)


def _front_end_unplugged(turns, window, rig, seconds):
    rig.front_end.cut_stream()
    turns.wait(seconds)


def _vibrometer_unplugged(turns, window, rig, seconds):
    rig.vibrometer.unplug()
    turns.wait(seconds)


def _shaker_unplugged(turns, window, rig, seconds):
    rig.modbus.stop()
    turns.wait(seconds)


HAPPENINGS = {
    "hold-resume-stop": _hold_and_stop,
    "front-end-hangs": _front_end_hangs,
    "front-end-unplugged": _front_end_unplugged,
    "vibrometer-unplugged": _vibrometer_unplugged,
    "shaker-unplugged": _shaker_unplugged,
}


def one_run(window, folder: Path, what: str, seconds: float) -> RegisterLooks:
    """Begun, swept for a while, befallen by `what`, stopped; looked at all the time."""
    folder.mkdir()
    turns = Turns()
    with (
        engine_rig(folder, sweep=LONG, virtual=False) as (rig, experiment),
        RegisterLooks(window, rig) as looks,
    ):
        run_until_driven(turns, window, rig, experiment, folder / "out")
        turns.wait(seconds)
        HAPPENINGS[what](turns, window, rig, seconds)
        if window.controller.running:
            window.controller.commands.stop()
        turns.waitUntil(lambda: not window.controller.running)
        turns.wait(1.0)
    return looks
