"""The simulated plate in its chamber at a few temperatures, under one law: its shift is found again."""

import json
import math

import pytest
from quick_run import no_fit

from drivers.simulated.climate import AMBIENT_C
from drivers.simulated.plant.law import wlf_shift
from instrument.cli.main import run
from instrument.run.experiment import run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.simulated_case import write_case

WARM_C = 32.0
CHAMBER = """
[chamber]
address = "simulated"
temperature_register = 100
set_point_register = 300
type = "float32"

"""
SWEEP = """
[temperature]
set_point_c = {set_point_c}
soak_s = 60.0

[sweep]
{calibration}
[[sweep.segments]]
low_hz = 16.0
high_hz = 25.0
points = 10
[[sweep.segments]]
low_hz = 90.0
high_hz = 115.0
points = 6
"""
CALIBRATION = "calibration.frequencies_hz = [40.0, 120.0, 240.0]"


def experiment_at(set_point_c, folder, calibration=CALIBRATION):
    """The simulated case, a quick chamber around its plate, without a hammer test."""
    folder.mkdir()
    path = write_case(folder)
    rig = (folder / "rig.toml").read_text().replace("[channels.base]", CHAMBER + "[channels.base]")
    quick = "\n[simulation]\nchamber = { air_s = 10.0, plate_s = 10.0 }\n"
    (folder / "rig.toml").write_text(rig.replace("\n[simulation]\n", quick))
    sweep = SWEEP.format(set_point_c=set_point_c, calibration=calibration)
    path.write_text(path.read_text().split("[hammer]")[0] + sweep)
    return read_whole_experiment(path)


@pytest.mark.long
def test_the_shift_between_two_soaked_sweeps_is_that_of_the_plates_core(tmp_path):
    experiments = [experiment_at(t, tmp_path / f"{t:g}") for t in (AMBIENT_C, WARM_C)]
    done = [run_experiment(e, e.path.parent, ("sweep",), fit=no_fit) for e in experiments]
    for finished, t in zip(done, (AMBIENT_C, WARM_C), strict=True):
        assert [p.temperature_c for p in finished.points] == pytest.approx(
            [t] * len(finished.points), abs=0.1
        )
    files = [str(finished.session) for finished in done]
    said = tmp_path / "shift.json"
    options = ["--specimen", str(tmp_path / "22" / "specimen.toml"), "--shift", "free", "--json", str(said)]
    assert run(["identify", *files, *options, "--reference-c", f"{AMBIENT_C:g}"]) == 0
    found = json.loads(said.read_text())
    assert found["simple"]
    warm = next(t for t in found["temperatures"] if t["temperature_c"] > 30)
    exact = wlf_shift(WARM_C - AMBIENT_C, 9.0, 120.0)
    assert 10 ** warm["log10_shift"] == pytest.approx(exact, rel=0.02)
    assert warm["log10_shift_standard_error"] < 0.01


@pytest.fixture(scope="module")
def uncalibrated(tmp_path_factory):
    """Sessions at three temperatures, the vibrometer's gain and delay left in them; the specimen's file."""
    folder = tmp_path_factory.mktemp("uncalibrated")
    experiments = [
        experiment_at(t, folder / f"{t:g}", "calibration = false") for t in (AMBIENT_C, 27.0, WARM_C)
    ]
    done = [run_experiment(e, e.path.parent, ("sweep",), fit=no_fit) for e in experiments]
    return [str(finished.session) for finished in done], folder / "22" / "specimen.toml"


@pytest.mark.long
@pytest.mark.parametrize("kind", ["free", "wlf"])
def test_sessions_without_a_calibration_give_the_shifts_beside_the_vibrometers_delay(
    uncalibrated, tmp_path, kind
):
    files, specimen = uncalibrated
    said = tmp_path / "shift.json"
    options = ["--specimen", str(specimen), "--shift", kind, "--reference-c", f"{AMBIENT_C:g}"]
    assert run(["identify", *files, *options, "--json", str(said)]) == 0
    found = json.loads(said.read_text())
    assert found["simple"]
    assert found["common_cause"]["name"] == "channel_delay"
    for at in found["temperatures"][1:]:
        exact = math.log10(wlf_shift(at["temperature_c"] - AMBIENT_C, 9.0, 120.0))
        assert abs(at["log10_shift"] - exact) < 3 * at["log10_shift_standard_error"]
        assert at["log10_shift_standard_error"] < 0.01
