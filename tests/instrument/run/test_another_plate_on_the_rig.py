"""A plate of another size on the simulated rig over its wires: struck bare, then swept."""

import pytest
from quick_run import no_fit

from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.shaken import ShakenPlate
from drivers.simulated.plates import ByHand
from instrument.files.new_file import write_new
from instrument.files.structure_file import read_structure
from instrument.run.experiment import run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.simulated_case import case_file
from instrument.simulated_case.plate import plate_mount

EXPERIMENT = """
specimen = "plate.toml"
rig = "rig.toml"
[hammer]
hits = 3
hit_x_mm = 240.0
hit_y_mm = 25.0
response_x_mm = 230.0
response_y_mm = 120.0
band_hz = [10.0, 600.0]
[sweep]
level_g = 0.5
sentinel = false
[[sweep.segments]]
mode = 1
span_percent = 40.0
points = 7
"""


@pytest.mark.long
def test_every_step_and_mode_is_the_other_plates(tmp_path):
    write_new("plate", tmp_path / "plate.toml")
    text = (tmp_path / "plate.toml").read_text()
    for old, new in (
        ("300.2 ", "250.0 "),
        ("199.9 ", "150.0 "),
        ("# [damping]", "[damping]"),
        ("# modal", "modal"),
    ):
        assert old in text
        text = text.replace(old, new, 1)
    (tmp_path / "plate.toml").write_text(text)
    rig = case_file("rig.toml").read_text() + 'noise = 0.0\nspecimen = "plate.toml"\n'
    (tmp_path / "rig.toml").write_text(rig)
    (tmp_path / "experiment.toml").write_text(EXPERIMENT)
    run = run_experiment(
        read_whole_experiment(tmp_path / "experiment.toml"), tmp_path, ("hammer", "sweep"), fit=no_fit
    )
    mount = plate_mount(read_structure(tmp_path / "plate.toml"), Effects())
    plate = ShakenPlate(mounted=mount(Effects(), ByHand()))
    for p in run.points:
        exact = plate.steady_state(p.frequency_hz)
        ratio = (p.velocity_m_s / p.base_m_s2) / (exact["spot_velocity"] / exact["base_acceleration"])
        assert ratio == pytest.approx(1.0, abs=1e-2)
    ratios = [m.damping_ratio for m in run.damping.result.modes if m.accepted]
    assert ratios[:3] == pytest.approx([3e-3, 1.5e-3, 2e-3], rel=0.02)
