"""The example plugin and the driver template, installed: named in files, used by the commands."""

import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pytest
from data_folder import DATA
from plugin_sites import EXAMPLES, ROOT, python

from instrument.session.storage import SessionFile
from instrument.simulated_case import case_file
from instrument.stream.derived import PointMeasured
from instrument.stream.raw import SessionBegan

pytestmark = pytest.mark.usefixtures("warm_site")

LAW = """[core.law]
kind = "fractional-kelvin-voigt"
g0_mpa = 0.4
tau_s = 5e-3
alpha = 0.6
"""
VIBROMETERS = {
    "analog": ('kind = "analog"\nscale_mm_s_v = 50.0\n', "by hand"),
    "template": ('kind = "template"\ntimeout_s = 0.5\n', "20mm/s/V"),
}
SWEEP = """specimen = "specimen.toml"
rig = "rig.toml"
[sweep]
sentinel = false
calibration = false
[[sweep.segments]]
low_hz = 95.0
high_hz = 107.0
points = 4
"""
RUN = """
from pathlib import Path
from instrument.run.experiment import run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.stream.derived import FitUpdated

def no_fit(number, last_step, points, damping, specimen):
    return FitUpdated(number, last_step, None, "not fitted")

if __name__ == "__main__":
    experiment = read_whole_experiment(Path("experiment.toml"))
    print(run_experiment(experiment, Path("."), ("sweep",), fit=no_fit).session)
"""


@pytest.fixture
def files(tmp_path):
    """A specimen with the example's law, and nine points."""
    text = (DATA / "numbers" / "coarse.toml").read_text()
    head, _, tail = text.partition("[core.law]")
    (tmp_path / "specimen.toml").write_text(head + LAW + "\n[damping]" + tail.partition("[damping]")[2])
    shutil.copy(DATA / "numbers" / "table5.csv", tmp_path)
    return tmp_path


@pytest.fixture(params=VIBROMETERS)
def experiment(request, tmp_path):
    """On the simulated rig with another vibrometer; its kind."""
    table, _ = VIBROMETERS[request.param]
    rig = case_file("rig.toml").read_text()
    rig = rig.replace('kind = "polytec"\n', table).replace('model = "OFV-5000"\n', "")
    (tmp_path / "rig.toml").write_text(rig)
    shutil.copy(case_file("specimen.toml"), tmp_path)
    (tmp_path / "experiment.toml").write_text(SWEEP)
    return request.param


def facts(done):
    assert done.returncode == 0, done.stderr
    assert "plugin" not in done.stderr
    return json.loads(done.stdout)


def test_the_version_lists_what_is_added_and_by_whom(cold, viscorig):
    done = viscorig("--version")
    assert done.stdout.splitlines()[1:] == [
        "  core law fractional-kelvin-voigt, from viscorig-example-plugin 0.1.0",
        "  effect crosstalk, from viscorig-example-plugin 0.1.0",
        "  vibrometer analog, from viscorig-example-plugin 0.1.0",
        "  vibrometer template, from viscorig-vibrometer-template 0.1.0",
    ]


def test_a_specimen_may_name_its_law(viscorig, files):
    predicted = facts(viscorig("predict", "specimen.toml", "--frequencies", "20:100:20", "--json", "-"))
    assert len(predicted["points"]) == 5


def test_its_law_is_identified(viscorig, files):
    found = facts(viscorig("identify", "table5.csv", "--specimen", "specimen.toml", "--json", "-"))
    assert found["law_kind"] == "fractional-kelvin-voigt"
    assert set(found["parameters"]) == {"g0_pa", "tau_s", "alpha"}


def test_its_effect_is_accepted_on_a_word_and_known_to_the_catalogue(viscorig, files):
    common = ("diagnose", "table5.csv", "--specimen", "specimen.toml")
    found = facts(viscorig(*common, "--accept", "crosstalk", "--json", "-"))
    (effect,) = found["effects"]
    assert effect["name"] == "crosstalk"
    assert effect["parameters"]["leak"]["unit"] == "mm/s per m/s^2"
    refused = viscorig(*common, "--accept", "nothing")
    assert refused.returncode == 2
    assert "core_thickness, crosstalk, exponential_window" in refused.stderr


def test_an_experiment_with_its_vibrometer_is_checked(viscorig, experiment):
    found = facts(viscorig("check", "experiment.toml", "--json", "-"))
    assert {s["range_name"] for s in found["segments"]} == {VIBROMETERS[experiment][1]}


@pytest.mark.skipif(os.name != "posix", reason="the simulated rig needs pseudo-terminals")
def test_an_experiment_with_its_vibrometer_is_run(site, experiment, tmp_path):
    (tmp_path / "run.py").write_text(RUN)
    done = python(site, tmp_path, "run.py")
    assert done.returncode == 0, done.stderr
    with SessionFile(tmp_path / done.stdout.strip().splitlines()[-1]) as session:
        events = list(session.events(with_samples=False))
        configuration = json.loads(session._file["configuration"][()])
    (began,) = [e for e in events if isinstance(e, SessionBegan)]
    points = [e for e in events if isinstance(e, PointMeasured)]
    said = {"analog": "50 mm/s/V stated", "template": "VIBRO 1,serial 42"}[experiment]
    assert said in began.instruments["vibrometer"]
    assert len(points) == 4
    assert all(abs(p.control_error_percent) < 1.0 for p in points)
    assert all(np.abs(p.velocity_m_s) > 1e-3 for p in points)
    # A session says what else took part, and keeps the driver's own keys.
    assert "viscorig-example-plugin" in configuration["versions"]
    assert configuration["rig"]["vibrometer"]["kind"] == experiment
    assert set(configuration["rig"]["vibrometer"]) > {"kind", "address", "reads"}


def test_a_wrong_key_of_its_driver_is_one_line(viscorig, experiment, tmp_path):
    path = tmp_path / "rig.toml"
    path.write_text(path.read_text().replace("[vibrometer]\n", "[vibrometer]\nbaud = 9600\n"))
    done = viscorig("check", "experiment.toml")
    assert done.returncode == 2
    assert "rig.toml: vibrometer.baud: unknown key" in done.stderr


def test_the_drivers_own_tests_pass(tmp_path):
    tests = EXAMPLES / "driver_template" / "tests"
    options = ("-q", "-c", os.devnull, "--rootdir", str(tests), "-p", "no:cacheprovider", "-W", "error")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])}
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *options, str(tests)],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout
    assert "29 passed" in done.stdout
