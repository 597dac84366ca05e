"""What is wrong between an experiment's files, a line each; the forecast is made by hand."""

from types import SimpleNamespace

import numpy as np
import pytest
from beam_cases import BEAM

from fitting.structures.beam import Beam
from instrument.check.dry_run import all_faults
from instrument.check.faults import experiment_objections
from instrument.check.forecast import Forecast
from instrument.session.configuration import read_whole_experiment
from instrument.simulated_case import case_file, write_case

FORECAST = Forecast(SimpleNamespace(), np.array([20.0, 60.0, 110.0]), np.ones(3))
RANGED = {
    "points = 25\n": 'points = 25\nrange = "20mm/s/V"\n',
    "points = 21\n": 'points = 21\nrange = "20mm/s/V"\n',
}
CHAMBER = """[chamber]
address = "simulated"
temperature_register = 100
type = "int16"
scale_c = 0.1
"""
SOAK = "[temperature]\nset_point_c = 30.0\n"


def objections(folder, parts=("hammer", "sweep"), *, experiment=None, rig=None, specimen=None):
    """Of the simulated case with texts replaced in its files; lines without their folders."""
    path = write_case(folder)
    for name, texts in (("experiment", RANGED | (experiment or {})), ("rig", rig), ("specimen", specimen)):
        target = folder / f"{name}.toml"
        text = target.read_text()
        for old, new in (texts or {}).items():
            assert old in text
            text = text.replace(old, new)
        target.write_text(text)
    whole = read_whole_experiment(path)
    return [line.replace(f"{folder}/", "") for line in experiment_objections(whole, FORECAST, parts)]


def test_the_case_as_it_is_has_nothing_against_it(tmp_path):
    assert objections(tmp_path) == []


def test_a_part_that_is_not_there_is_nothing_to_run(tmp_path):
    text = write_case(tmp_path).read_text()
    hammer = text[text.index("[hammer]") : text.index("[sweep]")]
    assert objections(tmp_path, ("hammer",), experiment={hammer: ""}) == [
        "experiment.toml: has no [hammer], nothing would be measured"
    ]
    assert objections(tmp_path, ("hammer", "sweep"), experiment={hammer: ""}) == []


def test_a_blow_beside_the_plate_is_said_for_each_coordinate(tmp_path):
    found = objections(
        tmp_path,
        experiment={"hit_x_mm = 285.0": "hit_x_mm = 301.0", "response_y_mm = 170.0": "response_y_mm = 201.0"},
    )
    assert found == [
        "experiment.toml: hammer.hit_x_mm = 301 is off the plate, expected 0 to 300.2",
        "experiment.toml: hammer.response_y_mm = 201 is off the plate, expected 0 to 199.9",
    ]
    # Asked for a sweep alone, nobody strikes.
    assert objections(tmp_path, ("sweep",), experiment={"hit_x_mm = 285.0": "hit_x_mm = 301.0"}) == []


def test_a_hammer_test_needs_its_channels(tmp_path):
    text = (write_case(tmp_path).parent / "rig.toml").read_text()
    force = text[text.index("[channels.force]") : text.index("[channels.response]")]
    assert objections(tmp_path, rig={force: ""}) == [
        "rig.toml: channels.force: missing, the hammer test needs it"
    ]


def test_steps_beyond_a_quarter_of_the_sampling_rate_are_said_segment_by_segment(tmp_path):
    far = {"low_hz = 235.0\nhigh_hz = 295.0": "low_hz = 2000.0\nhigh_hz = 2050.0"}
    assert objections(tmp_path, experiment=far) == [
        "experiment.toml: sweep.segments, number 3: 2050 Hz at 8192 samples/s, expected at most 2048 Hz"
    ]
    sentinel = {"level_g = 1.0\n": "level_g = 1.0\nsentinel = { frequency_hz = 3000.0 }\n"}
    assert objections(tmp_path, experiment=sentinel) == [
        "experiment.toml: sweep.sentinel: 3000 Hz at 8192 samples/s, expected at most 2048 Hz"
    ]


def test_a_mode_that_is_not_forecast_and_a_range_that_the_laser_lacks_are_said(tmp_path):
    found = objections(
        tmp_path,
        experiment={
            "mode = 3": "mode = 4",
            'points = 25\nrange = "20mm/s/V"': 'points = 25\nrange = "7mm/s/V"',
        },
    )
    assert found[0].startswith("experiment.toml: sweep.segments, number 1: range '7mm/s/V', expected one of ")
    assert found[1] == "experiment.toml: sweep.segments, number 2: mode 4, expected at most 3"


def test_a_level_beyond_the_rig_s_limit_is_said_with_both(tmp_path):
    (said,) = objections(tmp_path, experiment={"level_g = 1.0": "level_g = 6.0"})
    assert said.startswith("experiment.toml: sweep.level_g = 6 is ")
    assert "limit" in said
    assert "50" in said


@pytest.mark.parametrize(
    ("chamber", "said"),
    [
        ("", "rig.toml has no [chamber], expected one with a set point"),
        (CHAMBER, "[chamber] of rig.toml is a thermometer, expected one with a set point"),
        (f"{CHAMBER}set_point_register = 300\n", None),
    ],
)
def test_a_temperature_is_asked_of_a_chamber_that_has_a_set_point(tmp_path, chamber, said):
    found = objections(
        tmp_path,
        experiment={"[hammer]": f"{SOAK}[hammer]"},
        rig={"[channels.base]": f"{chamber}[channels.base]"},
    )
    assert found == ([f"experiment.toml: temperature.set_point_c = 30: {said}"] if said else [])


# What stands on the simulated rig


def test_another_plate_than_the_published_one_is_not_on_the_rig(tmp_path):
    (said,) = objections(tmp_path, ("sweep",), specimen={"length_mm = 300.2": "length_mm = 240.0"})
    assert said.startswith(
        "specimen.toml: the simulated rig has the published plate (300.2 x 199.9 mm), no other: "
    )
    assert "length is -20.1 % off the model's; expected that plate's specimen, or a real rig" in said


def test_the_published_plate_is_read_anywhere_by_a_rig_that_is_simulated_for_the_run(tmp_path):
    elsewhere = {"x_mm = 60.0": "x_mm = 80.0"}
    assert objections(tmp_path, ("sweep",), specimen=elsewhere) == []


def test_on_a_rig_simulated_for_any_client_it_is_read_at_its_spot_alone(tmp_path):
    elsewhere = {"x_mm = 60.0": "x_mm = 80.0"}
    hosts = {"host:port": "127.0.0.1:502", "serial port": "/dev/ttyUSB0", "URL": "http://127.0.0.1"}
    apart = {
        f'"simulated"               # {what}\n': f'"{at}"               # {what}\n'
        for what, at in hosts.items()
    }
    (said,) = objections(tmp_path, ("sweep",), specimen=elsewhere, rig=apart)
    assert said.startswith("specimen.toml: pickup at 80, 60 mm, but the simulated rig reads the published")
    assert said.endswith('address = "simulated" for all devices in rig.toml, which reads it anywhere')
    own = apart | {"seed = 1": 'seed = 1\nspecimen = "specimen.toml"'}
    assert objections(tmp_path, ("sweep",), specimen=elsewhere, rig=own) == []


def test_a_plate_that_stands_on_the_rig_is_the_one_that_is_stated(tmp_path):
    write_case(tmp_path)
    (tmp_path / "other.toml").write_text((tmp_path / "specimen.toml").read_text().replace("300.2", "240.0"))
    other = {"seed = 1": 'seed = 1\nspecimen = "other.toml"'}
    (said,) = objections(tmp_path, rig=other)
    assert said.startswith(
        "specimen.toml: on the simulated rig stands another plate (other.toml): length is "
    )
    assert objections(tmp_path, rig={"seed = 1": 'seed = 1\nspecimen = "specimen.toml"'}) == []
    (tmp_path / "beam.toml").write_text(BEAM)
    (said,) = objections(tmp_path, rig={"seed = 1": 'seed = 1\nspecimen = "beam.toml"'})
    assert (
        said
        == "specimen.toml: a plate, but on the simulated rig stands a beam (beam.toml): expected one kind"
    )


def of_a_beam(folder, boundary, parts):
    path = write_case(folder)
    (folder / "beam.toml").write_text(BEAM.replace("clamped-free", boundary).replace("150.0", "80.0"))
    path.write_text(path.read_text().replace("specimen.toml", "beam.toml"))
    whole = read_whole_experiment(path)
    assert isinstance(whole.the_specimen(), Beam)
    return experiment_objections(whole, FORECAST, parts)


def test_the_published_plate_stands_on_the_rig_unless_a_beam_is_put_there(tmp_path):
    (said,) = of_a_beam(tmp_path, "clamped-free", ())[1:]
    assert (
        'a beam, but the simulated rig has the published plate: expected [simulation] specimen = "beam.toml"'
        in said
    )


def test_a_beam_driven_in_its_centre_is_not_struck(tmp_path):
    said = of_a_beam(tmp_path, "centre-driven", ("hammer",))
    assert "a beam driven in its centre is not struck, expected no [hammer]" in said[-1]


def test_a_sweep_that_chooses_its_steps_is_of_a_plate(tmp_path):
    path = write_case(tmp_path)
    text = path.read_text()
    segments = text[text.index("[[sweep.segments]]") :]
    path.write_text(text.replace(segments, 'plan = "adaptive"\n[sweep.adaptive]\nband_hz = [15.0, 120.0]\n'))
    (tmp_path / "beam.toml").write_text(BEAM)
    path.write_text(path.read_text().replace("specimen.toml", "beam.toml"))
    said = experiment_objections(read_whole_experiment(path), FORECAST, ("sweep",))
    assert 'sweep.plan = "adaptive": the specimen is a beam, expected a plate, or segments' in said[-1]


def test_a_specimen_in_the_place_of_an_experiment_is_one_fault():
    path = case_file("specimen.toml")
    (said,) = all_faults(path)
    assert said == (
        f"{path}: a specimen, expected an experiment, which names its specimen and its rig "
        "(viscorig new experiment)"
    )


def test_so_is_a_rig_which_hears_what_asks_its_instruments():
    path = case_file("rig.toml")
    (said,) = all_faults(path)
    assert said.startswith(f"{path}: a rig, expected an experiment")
    assert "'viscorig doctor'" in said


def test_a_set_point_that_the_simulated_chamber_does_not_reach_is_refused(tmp_path):
    chamber = CHAMBER + "set_point_register = 300\n\n"
    for asked, said in (("30.0", False), ("60.0", True)):
        (tmp_path / asked).mkdir()
        soak = SOAK.replace("30.0", asked)
        found = objections(
            tmp_path / asked,
            experiment={"[sweep]\n": f"{soak}\n[sweep]\n"},
            rig={"[operator]\n": f"{chamber}[operator]\n"},
        )
        assert (
            any("set_point_c = 60: the simulated chamber goes from 0 to 50" in one for one in found) == said
        )
