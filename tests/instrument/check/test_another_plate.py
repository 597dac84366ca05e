"""Another plate than the stated one is not swept."""

from types import SimpleNamespace

import pytest
from impact_cases import BARE_HZ, TABLE_3
from sessions import configuration

from instrument.cli.main import run
from instrument.errors import RigStopped
from instrument.facts.damping import DampingResult
from instrument.run.session_run import SessionRun
from instrument.simulated_case import write_case
from instrument.stream.derived import DampingFound


@pytest.mark.parametrize(
    ("stated", "meant"),
    [("length_mm = 300.2", "length_mm = 240.0"), ("young_gpa = 68.9", "young_gpa = 120.0")],
    ids=["length", "substrate"],
)
def test_the_simulated_rig_refuses_another_specimen(capsys, tmp_path, stated, meant):
    experiment = write_case(tmp_path)
    specimen = tmp_path / "specimen.toml"
    assert stated in specimen.read_text()
    specimen.write_text(specimen.read_text().replace(stated, meant))
    assert run(["run", str(experiment), "--out", str(tmp_path / "out")]) == 2
    line = capsys.readouterr().err.strip()
    assert "\n" not in line
    assert "the simulated rig has the published plate" in line
    assert not list(tmp_path.glob("out/*"))


def hammer_test(frequencies_hz):
    modes = [
        {
            "frequency_hz": f,
            "damping_ratio": z,
            "channel": "response",
            "half_power": None,
            "rational_fit": None,
            "lscf": None,
            "lines_in_bandwidth": 9.0,
            "accepted": True,
            "why": "",
        }
        for f, z in zip(frequencies_hz, TABLE_3, strict=True)
    ]
    return DampingFound(DampingResult.model_validate({"modes": modes, "hits": [], "warnings": []}))


def question(frequencies_hz):
    run_of_it = SimpleNamespace(_configuration=configuration())
    SessionRun._question_plate(run_of_it, hammer_test(frequencies_hz))


def test_a_bare_plate_of_other_modes_stops_before_the_sweep():
    with pytest.raises(RigStopped, match=r"stopped before the sweep.*--resume"):
        question(1.37 * BARE_HZ)


def test_the_stated_plate_goes_on():
    question(BARE_HZ)
