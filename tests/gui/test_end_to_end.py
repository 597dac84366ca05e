"""The real window on a real X server, driven with mouse and keys: form, diagnosis, replay, stop."""

import json
import os
import shutil
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from instrument.simulated_case import write_case

DRIVER = Path(__file__).parents[1] / "helpers" / "window_driver.py"
EXPERIMENT = """
specimen = "specimen.toml"
rig = "rig.toml"
[hammer]
hits = 2
hit_x_mm = 285.0
hit_y_mm = 25.0
response_x_mm = 270.0
response_y_mm = 170.0
record_s = 8.0
[sweep]
sentinel = false
calibration = false
[[sweep.segments]]
mode = 1
span_percent = 50.0
points = 6
[[sweep.segments]]
mode = 3
span_percent = 25.0
points = 6
"""
MESH = "[mesh]\nelements_x = 8\nelements_y = 5\n"


@contextmanager
def screen():
    """An X server without a monitor; its DISPLAY."""
    reading, writing = os.pipe()
    command = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1400x800x24", "-nolisten", "tcp"]
    with subprocess.Popen(command, pass_fds=[writing], stderr=subprocess.DEVNULL) as server:
        os.close(writing)
        try:
            with os.fdopen(reading) as told:
                number = told.readline().strip()
            assert number, "Xvfb did not start"
            yield f":{number}"
        finally:
            server.terminate()


@pytest.mark.skipif(
    shutil.which("Xvfb") is None or shutil.which("xdotool") is None,
    reason="needs Xvfb and xdotool (Debian: xvfb, xdotool)",
)
@pytest.mark.long
def test_a_person_runs_an_experiment_from_the_form_to_the_diagnosis(tmp_path):
    experiment = write_case(tmp_path)
    experiment.write_text(EXPERIMENT)
    with (tmp_path / "specimen.toml").open("a") as file:
        file.write(MESH)
    with screen() as display:
        environment = {
            **os.environ,
            "DISPLAY": display,
            "QT_QPA_PLATFORM": "xcb",
            "OPENBLAS_NUM_THREADS": "1",
        }
        done = subprocess.run(
            [sys.executable, str(DRIVER), str(experiment)],
            env=environment,
            capture_output=True,
            text=True,
            timeout=300,
        )
    assert done.returncode == 0, done.stderr[-2000:]
    seen = json.loads(done.stdout.splitlines()[-1])
    assert "2 good hits" in seen["asked"]
    assert seen["hits"] == 3
    assert (seen["ended"], seen["title"], seen["points"]) == ("done", "at a real screen", 12)
    assert seen["verdict"] in ("none", "effect", "ambiguous", "unknown")
    assert seen["replayed"]
    assert seen["stopped"] == "stopped by the user"
    assert "the shaker is silent" in seen["said"]
    assert done.stderr.strip() == ""
