"""A whole experiment on the simulated rig over its wires, against what the plant itself knows."""

from pathlib import Path

import numpy as np
import pytest
from quick_run import no_fit

from drivers.simulated.plant.bare import StruckPlate
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.shaken import ShakenPlate
from instrument.errors import RigStopped
from instrument.run import striking
from instrument.run.experiment import run_experiment
from instrument.run.replay import replay
from instrument.session.configuration import read_whole_experiment
from instrument.session.storage import SessionFile
from instrument.simulated_case import write_case
from instrument.stream.derived import CalibrationFound, DiagnosisFound, HitJudged
from instrument.stream.raw import StepBegan

pytestmark = pytest.mark.usefixtures("warm")

RATIOS = np.array([0.29, 0.13, 0.18, 0.21, 0.11, 0.07, 0.09, 0.04]) / 100


def no_diagnosis(asked):
    return DiagnosisFound(asked.number, asked.last_step, None, "not diagnosed")


def thinned_case(folder):
    path = write_case(folder)
    path.write_text(
        path.read_text().replace("points = 25", "points = 9").replace("points = 21", "points = 7")
    )
    return path


@pytest.fixture(scope="module")
def quiet_run(tmp_path_factory):
    """The case without sensor noise, a third of its points: what is left is the measurement's own error."""
    folder = tmp_path_factory.mktemp("quiet")
    path = thinned_case(folder)
    rig = folder / "rig.toml"
    rig.write_text(rig.read_text() + "noise = 0.0\n")
    return run_experiment(read_whole_experiment(path), folder, ("sweep",), fit=no_fit)


@pytest.fixture(scope="module")
def demo_run(tmp_path_factory):
    """A third of the case's points, sensor noise and live fits included, up to its diagnosis."""
    folder = tmp_path_factory.mktemp("demo")
    experiment = read_whole_experiment(thinned_case(folder))
    return run_experiment(experiment, folder, ("hammer", "sweep"), diagnose=no_diagnosis)


@pytest.fixture(scope="module")
def plant():
    return ShakenPlate(Effects())


def steps(run):
    return [p for p in run.points if p.purpose == "step"]


def test_a_hammer_test_whose_blows_are_all_refused_is_given_up_and_says_why(tmp_path, monkeypatch):
    monkeypatch.setattr(striking, "HITS_IN_VAIN", 2)
    path = write_case(tmp_path)
    rig = tmp_path / "rig.toml"
    rig.write_text(rig.read_text().replace("= 20.0      # per N", "= 2000.0"))
    with pytest.raises(RigStopped, match=r"no good hit of 2: the last was refused: .*overload of the force"):
        run_experiment(read_whole_experiment(path), tmp_path, ("hammer",), fit=no_fit)


def test_every_step_reads_the_plants_steady_state(quiet_run, plant):
    found = steps(quiet_run)
    assert found
    for p in found:
        exact = plant.steady_state(p.frequency_hz)
        ratio = (p.velocity_m_s / p.base_m_s2) / (exact["spot_velocity"] / exact["base_acceleration"])
        assert abs(abs(ratio) - 1) < 2e-3
        assert abs(np.degrees(np.angle(ratio))) < 0.2


def test_the_level_holds_at_every_step_though_the_shaker_varies_twenty_decibels(quiet_run, demo_run, plant):
    gains = [abs(plant.steady_state(f)["base_acceleration"]) for f in np.linspace(14, 310, 300)]
    assert 20 * np.log10(max(gains) / min(gains)) > 18
    for run in (quiet_run, demo_run):
        assert max(abs(p.control_error_percent) for p in steps(run)) < 1.0


@pytest.mark.parametrize("which", ["quiet_run", "demo_run"])
def test_a_sweep_takes_little_more_than_the_plant_needs_to_settle(which, request, plant):
    """Least time: the slowest vibration falls to 0.1 %, and the dwell. Loop checks and sentinels count."""
    run = request.getfixturevalue(which)
    poles = plant.poles()
    vibrating = poles[(poles.imag > 2 * np.pi * 10) & (poles.imag < 2 * np.pi * 600)]
    settle_s = np.log(1000) / np.abs(vibrating.real).min()
    least = sum(settle_s + p.dwell_s for p in run.points)
    assert samples_s(run.session) < 1.4 * least


def samples_s(session: Path) -> float:
    """Length of the sweep part, everything in it."""
    total, sweeping, rate = 0, False, 1.0
    with SessionFile(session) as file:
        for event in file.events(with_samples=False):
            if type(event).__name__ == "AcquisitionBegan":
                sweeping, rate = event.part == "sweep", event.sample_rate_hz
            elif type(event).__name__ == "BlockAcquired" and sweeping:
                total += event.samples
    return total / rate


def test_gain_and_delay_are_calibrated_in_place(quiet_run):
    with SessionFile(quiet_run.session) as file:
        found = [e for e in file.events(with_samples=False) if isinstance(e, CalibrationFound)]
    assert len(found) >= 3
    # 1.1 ms of the vibrometer and half a sample of skew between the inputs.
    for one in found:
        assert one.gain == pytest.approx(1.0, abs=5e-4)
        assert one.delay_s == pytest.approx(1.1e-3 + 0.5 / 8192, abs=1e-6)


def test_the_hammer_gives_the_papers_eight_ratios_and_the_plants_frequencies(demo_run):
    modes = demo_run.damping.result.accepted
    frequency_hz, ratio = StruckPlate((0.285, 0.025), (0.270, 0.170), 0.6e-3).modes()
    assert [m.frequency_hz for m in modes] == pytest.approx(frequency_hz, rel=5e-4)
    assert [m.damping_ratio for m in modes] == pytest.approx(ratio, rel=0.03)
    assert [m.damping_ratio for m in modes] == pytest.approx(RATIOS, rel=0.03)
    assert sum(m.half_power is not None for m in modes) == 8


def test_a_double_hit_is_told_from_a_good_one(demo_run):
    with SessionFile(demo_run.session) as file:
        hits = [e for e in file.events(with_samples=False) if isinstance(e, HitJudged)]
    assert [h.hit for h in hits if not h.accepted] == [4]
    assert "double hit" in hits[3].why


def test_the_law_is_the_plants_within_its_band(demo_run):
    law = {row.frequency_hz: row for row in demo_run.fit.result.law}
    for f in (20.0, 100.0, 280.0):
        G = complex(ShakenPlate(Effects()).plate.core_law.modulus(2 * np.pi * f))
        storage, loss = law[f].storage_modulus_pa, law[f].loss_factor
        assert storage == pytest.approx(G.real, rel=0.02)
        assert loss == pytest.approx(G.imag / G.real, rel=0.03)
        assert abs(storage - G.real) < 1.96 * law[f].storage_modulus_standard_error_pa
        assert abs(loss - G.imag / G.real) < 1.96 * law[f].loss_factor_standard_error


@pytest.mark.long
def test_a_whole_session_replays_to_the_bit(tmp_path):
    run = run_experiment(read_whole_experiment(write_case(tmp_path)), tmp_path, ("hammer", "sweep"))
    with SessionFile(run.session) as file:
        again = replay(file)
    assert again.differences == []
    assert again.fit == run.fit
    assert again.diagnosis == run.diagnosis


def test_nothing_the_rig_hides_is_in_the_session(tmp_path):
    path = write_case(tmp_path, effect="added_mass")
    experiment = tmp_path / "experiment.toml"
    head = experiment.read_text().split("[[sweep.segments]]")[0].split("[hammer]")[0]
    experiment.write_text(
        head + "[sweep]\nsentinel = false\ncalibration = false\n"
        "[[sweep.segments]]\nlow_hz = 100.0\nhigh_hz = 101.0\npoints = 2\n"
    )
    run = run_experiment(read_whole_experiment(path), tmp_path, ("sweep",), fit=no_fit)
    content = run.session.read_bytes()
    assert b"added_mass" not in content
    assert b"0.008" not in content
    with SessionFile(run.session) as file:
        assert "simulation" not in file.configuration.model_dump_json(exclude_none=True)
        assert any(isinstance(e, StepBegan) for e in file.events(with_samples=False))
