"""`viscorig plan` as a user calls it."""

import json
import re
from pathlib import Path

import pytest
from json_schema import faults

from instrument.cli.main import run
from instrument.facts.schema import schema_of
from instrument.paper_case import case_file
from instrument.planning import spots
from instrument.simulated_case import write_case

COARSE = "\n[mesh]\nelements_x = 12\nelements_y = 8\n"
BAND = ("--band", "15:120")


def call(capsys, *arguments):
    status = run([str(a) for a in arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


@pytest.fixture(scope="module")
def specimen(tmp_path_factory):
    """The paper's plate on a coarse mesh, known as well as a careful laboratory knows it."""
    path = tmp_path_factory.mktemp("plan") / "specimen.toml"
    text = re.sub(r"^exact = true.*$", "", case_file("zn1.toml").read_text(), flags=re.M)
    path.write_text(re.sub(r"\[mesh\][^\[]*", "", text) + COARSE)
    return path


@pytest.fixture(scope="module")
def planned(specimen, tmp_path_factory):
    """One plan, its JSON, its experiment and its figures."""
    folder = tmp_path_factory.mktemp("planned")
    write_case(folder)
    experiment = folder / "experiment.toml"
    few = pytest.MonkeyPatch()
    few.setattr(spots, "_ALONG", (0.2, 0.6))
    few.setattr(spots, "_ACROSS", (0.3,))
    more = ("--target", 3, "--experiment", experiment, "--figures", folder, "--json", folder / "plan.json")
    assert run([str(a) for a in ("plan", specimen, *BAND, *more)]) == 0
    few.undo()
    return json.loads((folder / "plan.json").read_text()), folder


def test_the_json_is_as_its_schema_says(planned):
    assert faults(planned[0], schema_of("plan")) == []


def test_steps_lie_in_the_band_with_both_ends_and_segments_add_up(planned):
    found = planned[0]
    f = [s["frequency_hz"] for s in found["steps"]]
    assert f == sorted(f)
    assert f[0] == found["band_low_hz"] == 15.0
    assert f[-1] == found["band_high_hz"] == 120.0
    assert sum(p["steps"] for p in found["segments"]) == len(f)
    assert sum(s["seconds"] for s in found["steps"]) == pytest.approx(found["seconds"])


def test_a_target_is_met_by_the_plans_own_prediction_or_said_to_be_out_of_reach(planned):
    found = planned[0]
    worst = max(max(r["storage_modulus_percent"], r["loss_factor_percent"]) for r in found["law"])
    assert worst == pytest.approx(found["worst_percent"])
    assert found["reached"] == (worst <= found["target_percent"])
    assert found["limit_percent"] <= worst
    if not found["reached"]:
        assert found["limited_by"]
    # Nothing more known leaves less than that, with the same readings.
    assert all(one["worst_percent"] < found["limit_percent"] for one in found["limited_by"])


def test_a_share_of_the_time_separates_causes(planned):
    seconds = {"law": 0.0, "causes": 0.0}
    for s in planned[0]["steps"]:
        seconds[s["teaches"]] += s["seconds"]
    # A quarter as they are chosen; the loop checks of the whole come to it, wherever they fall.
    assert 0 < seconds["causes"] <= 0.3 * sum(seconds.values())


def test_spots_are_ranked_and_hold_the_stated_one(planned):
    found = planned[0]["spots"]
    assert sum(s["stated"] for s in found) == 1
    reached = [s["reached"] for s in found]
    assert reached == sorted(reached, reverse=True)


def test_what_is_known_to_hide_is_said_to_hide(planned):
    # A thickness that is off scales the core's stiffness: only the law could be meant.
    effects = {e["name"]: e for e in planned[0]["effects"]}
    assert effects["core_thickness"]["chance_seen"] < 0.5
    rivals = {r["name"] for r in effects["channel_delay"]["rivals"]}
    assert "sensor_lowpass" in rivals


@pytest.mark.long
def test_the_experiment_keeps_everything_but_its_sweep_and_is_accepted(planned, capsys):
    found, folder = planned
    status, out, err = call(capsys, "check", folder / "experiment.toml", "--json", "-")
    assert status == 0, err
    checked = json.loads(out)
    assert sum(s["steps"] for s in checked["segments"]) == len(found["steps"])
    text = (folder / "experiment.toml").read_text()
    assert "[hammer]" in text
    assert text.count("[sweep]") == 1


def test_figures_are_saved(planned):
    for name in ("plan-errors.png", "plan-spots.png"):
        assert (planned[1] / name).stat().st_size > 5000


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--band", "40"), "expected LOW:HIGH"),
        (("--band", "100:20"), "LOW < HIGH"),
        (("--band", "nan:20"), "LOW < HIGH"),
        (("--target", "0"), "target"),
        (("--noise", "0", "--floor", "0"), "no reading is exact"),
        (("--hammer", "nothing.json"), "nothing.json"),
        (("--level", "20g"), "--level 20g is 196 m/s^2"),
    ],
)
def test_a_wrong_wish_is_refused_in_one_line(capsys, specimen, arguments, said):
    status, out, err = call(capsys, "plan", specimen, *arguments)
    assert status == 2
    assert out == ""
    assert said in err
    assert len(err.splitlines()) == 1


def test_what_has_no_law_or_is_no_plate_is_refused(capsys, tmp_path, specimen):
    bare = tmp_path / "bare.toml"
    bare.write_text(re.sub(r"\[constraining\].*?\[damping\]", "[damping]", specimen.read_text(), flags=re.S))
    status, _, err = call(capsys, "plan", bare)
    assert (status, "bare plate has no core" in err) == (2, True)
    assert run(["new", "beam", str(tmp_path / "beam.toml")]) == 0
    capsys.readouterr()
    status, _, err = call(capsys, "plan", tmp_path / "beam.toml")
    assert (status, "expected a plate" in err) == (2, True)


def test_an_experiment_that_cannot_be_read_is_left_as_it_is(capsys, specimen, tmp_path):
    path = tmp_path / "experiment.toml"
    path.write_text("nonsense = true\n")
    status, _, err = call(capsys, "plan", specimen, "--experiment", path)
    assert status == 2
    assert str(path) in err
    assert Path(path).read_text() == "nonsense = true\n"


LAW = r"kind = .*?(?=\n\s*\n|\n\[)"


@pytest.mark.parametrize(
    ("law", "said"),
    [
        ('kind = "isd112"', "core law isd112 has no numbers that a sweep could find"),
        (
            'kind = "fractional-zener"\ng0_mpa = 1.0\nginf_mpa = 1.0\ntau_s = 1e-4\nalpha = 0.5',
            "the core's law has no loss from 15 to 120 Hz",
        ),
        ('kind = "constant"\ng_mpa = 1.0\nloss_factor = 0.0', "the core's law has no loss from 15 to 120 Hz"),
    ],
)
def test_a_law_without_numbers_or_without_loss_is_refused_in_one_line(capsys, specimen, tmp_path, law, said):
    path = tmp_path / "specimen.toml"
    path.write_text(re.sub(LAW, law, specimen.read_text(), count=1, flags=re.S))
    status, out, err = call(capsys, "plan", path, *BAND, "--no-spots")
    assert (status, out) == (2, "")
    assert said in err
    assert len(err.splitlines()) == 1


def test_below_the_first_resonance_it_is_that_which_rings(capsys, specimen):
    status, out, err = call(capsys, "plan", specimen, "--band", "2:6", "--no-spots", "--json", "-")
    assert status == 0, err
    steps = json.loads(out)["steps"]
    assert [steps[0]["frequency_hz"], steps[-1]["frequency_hz"]] == [2.0, 6.0]


def test_a_spot_beside_the_clamp_is_planned_for(capsys, specimen, tmp_path):
    # A shorter free length puts it onto the clamp, where nothing moves.
    path = tmp_path / "specimen.toml"
    path.write_text(re.sub(r"x_mm = \S+", "x_mm = 5.0", specimen.read_text(), count=1))
    assert "x_mm = 5.0" in path.read_text()
    status, out, err = call(capsys, "plan", path, *BAND, "--no-spots", "--json", "-")
    assert status == 0, err
    assert json.loads(out)["x_mm"] == pytest.approx(5.0)


def test_impossible_stated_numbers_are_asked_about_as_by_check(capsys, specimen, tmp_path):
    path = tmp_path / "specimen.toml"
    path.write_text(re.sub(r"young_gpa = \S+", "young_gpa = 68900.0", specimen.read_text(), count=1))
    status, out, err = call(capsys, "plan", path, *BAND, "--no-spots")
    assert (status, out) == (2, "")
    assert "is it in MPa?; --force to go on all the same" in err
    assert len(err.splitlines()) == 1


def test_a_level_that_exceeds_a_limit_is_said_beside_the_headline(capsys, specimen):
    status, out, err = call(capsys, "plan", specimen, *BAND, "--no-spots", "--level", "4.6g")
    assert status == 0, err
    assert "this level takes more than 80 % of a usual limit: base acceleration 45.1 m/s^2" in out
