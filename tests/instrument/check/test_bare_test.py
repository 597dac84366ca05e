"""What a hammer test of the bare plate could not find is said before it is made."""

import re

import numpy as np
import pytest
from beam_cases import BEAM

from instrument.check.bare_test import BareShapes, bare_test_objections, bare_test_remarks
from instrument.check.dry_run import all_faults, dry_run
from instrument.cli.main import run
from instrument.session.configuration import read_whole_experiment
from instrument.simulated_case import write_case


def whole(folder, **changes):
    """The simulated case with other numbers in its [hammer]."""
    path = write_case(folder)
    text = path.read_text()
    for key, value in changes.items():
        text, count = re.subn(rf"(?m)^{key} = .*$", f"{key} = {value}", text)
        if not count:
            text = text.replace("[hammer]", f"[hammer]\n{key} = {value}")
    path.write_text(text)
    experiment = read_whole_experiment(path)
    return experiment, experiment.document.hammer


def test_the_case_as_it_is_gives_nothing_to_say(tmp_path):
    assert list(bare_test_objections(*whole(tmp_path))) == []
    assert list(bare_test_remarks(*whole(tmp_path))) == []


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("hit_x_mm", 0.0, "hammer.hit_x_mm = 0: in the clamp, where nothing moves"),
        ("response_x_mm", 0.0, "hammer.response_x_mm = 0: in the clamp, where nothing moves"),
        ("band_hz", [10.0, 6000.0], "hammer.band_hz up to 6000 Hz at 8192 samples/s, expected at most 4096"),
        ("band_hz", [2.0, 9.0], "hammer.band_hz = [2, 9] has none of the modes of the bare plate"),
    ],
)
def test_a_test_of_which_nothing_can_come_is_a_fault(tmp_path, key, value, said):
    experiment, _ = whole(tmp_path, **{key: value})
    (found,) = all_faults(experiment.path)
    assert said in found


def test_a_blow_on_the_axis_loses_the_modes_that_twist(tmp_path):
    experiment, hammer = whole(tmp_path, hit_y_mm=99.95)
    (said,) = bare_test_remarks(experiment, hammer)
    assert said.startswith("hammer.hit at 285, 99.95 mm is on a nodal line of 3 of 8 modes of the bare plate")
    assert said in dry_run(experiment.path).warnings


def test_a_record_in_which_nothing_decays_is_warned_of(tmp_path):
    (said,) = bare_test_remarks(*whole(tmp_path, record_s=0.25))
    assert "the slowest mode still has 93 % of its start" in said
    assert said.endswith("expected 15 s as auto has it")
    assert list(bare_test_remarks(*whole(tmp_path, record_s=6.0))) == []


def with_damping(folder, percent, **changes):
    """`whole`, with other damping stated of the plate."""
    experiment, _ = whole(folder, **changes)
    specimen = folder / "specimen.toml"
    text, count = re.subn(r"(?m)^modal_percent = .*$", f"modal_percent = {percent}", specimen.read_text())
    assert count
    specimen.write_text(text)
    experiment = read_whole_experiment(experiment.path)
    return experiment, experiment.document.hammer


@pytest.mark.parametrize("record_s", [200.0, 300.0])
def test_no_longer_record_is_asked_for_than_a_file_may_state(tmp_path, record_s):
    (said,) = bare_test_remarks(*with_damping(tmp_path, [0.001], record_s=record_s))
    assert said.startswith(f"hammer.record_s = {record_s:g}: at its end the slowest mode still has")
    assert said.endswith("4138 s would leave 1 %, 300 s is the most a record may be")
    assert "expected" not in said


@pytest.mark.parametrize(
    ("percent", "said"),
    [
        ([0.05], ["still has 3.6 % of its start: 83 s would leave 1 %: state record_s = 83 if"]),
        ([0.001], ["still has 94 % of its start: 4138 s would leave 1 %: state record_s = 300 if"]),
        ([0.3], []),
    ],
)
def test_a_record_that_auto_cuts_says_how_long_it_would_have_to_be(tmp_path, percent, said):
    found = list(bare_test_remarks(*with_damping(tmp_path, percent)))
    assert len(found) == len(said)
    for one, expected in zip(found, said, strict=True):
        assert one.startswith('hammer.record_s = "auto" ends at 60 s, its most, where the slowest mode')
        assert expected in one


def test_of_a_beam_its_clamp_and_its_frequencies_are_known(tmp_path):
    path = write_case(tmp_path)
    (tmp_path / "beam.toml").write_text(BEAM)
    text = path.read_text().replace("specimen.toml", "beam.toml")
    path.write_text(re.sub(r"(?m)^hit_x_mm = .*$", "hit_x_mm = 0.0", text))
    experiment = read_whole_experiment(path)
    said = list(bare_test_objections(experiment, experiment.document.hammer))
    assert "hammer.hit_x_mm = 0: in the clamp" in said[0]
    f = BareShapes.of(experiment.the_specimen()).frequency_hz
    assert np.all(np.diff(f) > 0)


def test_the_templates_raise_no_alarm(tmp_path, capsys):
    for kind, name in (("plate", "specimen.toml"), ("experiment", "experiment.toml"), ("rig", "rig.toml")):
        assert run(["new", kind, str(tmp_path / name)]) == 0
    assert run(["check", str(tmp_path / "experiment.toml")]) == 0
    warned = [line for line in capsys.readouterr().out.splitlines() if line.startswith("warning")]
    assert [w for w in warned if "from memory" not in w] == []
