"""What is wrong with an experiment is said at once, before anything is connected."""

import json

import pytest
from called import call

from instrument.check.dry_run import all_faults, dry_run
from instrument.cli.main import run
from instrument.files.new_file import write_new
from instrument.simulated_case import EFFECTS, write_case

pytestmark = pytest.mark.usefixtures("warm")

CHAMBER = """
[chamber]
address = "simulated"
temperature_register = 100
set_point_register = 300
type = "int16"
scale_c = 0.1

[channels.base]"""
SERIAL = '[chamber]\nkind = "serial"\naddress = "simulated"\n[channels.base]'


def edited(folder, name="experiment.toml", **changes):
    """The simulated case with texts replaced in one of its files."""
    path = write_case(folder)
    target = folder / name
    text = target.read_text()
    for old, new in changes.pop("texts").items():
        assert old in text
        text = text.replace(old, new)
    target.write_text(text)
    return path


def test_the_case_as_it_is_has_no_fault_and_a_forecast(tmp_path):
    path = write_case(tmp_path)
    assert all_faults(path) == []
    forecast = dry_run(path)
    assert [s.steps for s in forecast.segments] == [25, 21, 21]
    assert forecast.mode_hz[0] == pytest.approx(20.3, abs=0.5)
    first = forecast.segments[0]
    assert first.travel_m == pytest.approx(9.81 / (2 * 3.14159 * first.low_hz) ** 2, rel=1e-3)
    assert 60 < forecast.seconds < 600


def test_everything_wrong_is_said_at_once(tmp_path):
    path = edited(
        tmp_path,
        texts={
            "hit_x_mm = 285.0": "hit_x_mm = 985.0",
            "mode = 3": "mode = 29",
            "low_hz = 235.0\nhigh_hz = 295.0": "low_hz = 3500.0\nhigh_hz = 3600.0",
            "level_g = 1.0": "level_g = 7.0",
        },
    )
    said = "\n".join(all_faults(path))
    for word in ("hit_x_mm = 985", "mode 29", "3600 Hz at 8192 samples/s", "level_g = 7"):
        assert word in said


@pytest.mark.parametrize(
    ("name", "old", "new", "said"),
    [
        ("rig.toml", "seed = 1", "effects.added_masss = { mass_kg = 1.0 }", "added_masss"),
        ("rig.toml", "seed = 1", "effects.added_mass = { mass_kg = 0.01 }", "added_mass"),
        ("rig.toml", "seed = 1", 'log = "no/such/folder.log"', "no such folder"),
        ("rig.toml", "seed = 1", "vibrometer_delay_s = 1e9", "vibrometer_delay_s"),
        ("rig.toml", 'kind = "modbus-tcp"', "registers = { foo = 3 }", "foo"),
        ("rig.toml", 'model = "OFV-5000"', 'model = "OFV-1"', "OFV-1"),
        ("rig.toml", "input = 2", "input = 1", "input 1 is given to both"),
        ("experiment.toml", "[hammer]", "[temperature]\nset_point_c = 30.0\n[hammer]", "has no [chamber]"),
        (
            "experiment.toml",
            "[hammer]",
            "[temperature]\nset_point_c = 30.0\nsoak_s = 9e3\n[hammer]",
            "soak_s = 9000 is not below most_s = 7200",
        ),
        ("rig.toml", "[channels.base]", CHAMBER.replace('"int16"', '"int32"'), "chamber.type: 'int32'"),
        ("rig.toml", "[channels.base]", CHAMBER.replace("scale_c = 0.1\n", ""), "scale_c: missing"),
        ("rig.toml", "[channels.base]", CHAMBER.replace('"simulated"', '"a:1"'), "for all devices or none"),
        ("rig.toml", "[channels.base]", SERIAL, "chamber.kind: 'serial' is not simulated"),
        ("experiment.toml", "points = 25", "step_hz = 1e-300", "step_hz"),
        ("experiment.toml", "span_percent = 50.0", 'range = "7mm/s/V"', "7mm/s/V"),
        ("experiment.toml", "[hammer]", "[hammer]\npre_trigger_s = 5.0", "pre_trigger_s"),
        ("specimen.toml", "poisson = 0.3", "poisson = 0.7", "poisson"),
    ],
)
def test_a_fault_in_any_file_is_found_by_check_and_refused_by_run(tmp_path, capsys, name, old, new, said):
    path = edited(tmp_path, name, texts={old: new})
    assert said in "\n".join(all_faults(path))
    assert run(["run", str(path), "--out", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert error.startswith("viscorig: ")
    assert error.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_a_soak_is_said_and_counted(tmp_path, capsys):
    plain = dry_run(write_case(tmp_path)).seconds
    path = edited(tmp_path, "rig.toml", texts={"[channels.base]": CHAMBER})
    path.write_text(path.read_text().replace("[hammer]", "[temperature]\nset_point_c = 30.0\n[hammer]"))
    assert run(["check", str(path)]) == 0
    assert "chamber: 30 °C within 0.5 °C for 600 s, given up after 7200 s" in capsys.readouterr().out
    assert dry_run(path).seconds == pytest.approx(plain + 600.0)


def test_a_part_that_the_experiment_does_not_have_is_refused(tmp_path, capsys):
    path = write_case(tmp_path)
    text = path.read_text()
    head, tail = text.split("[hammer]")
    path.write_text(head + "[sweep]" + tail.split("[sweep]")[1])
    assert run(["hammer", str(path)]) == 2
    assert "has no [hammer]" in capsys.readouterr().err


@pytest.mark.parametrize("effect", EFFECTS)
def test_every_effect_a_demonstration_may_hide_is_well_written(tmp_path, effect):
    assert all_faults(write_case(tmp_path, effect=effect)) == []


def test_a_drive_limit_that_cannot_reach_the_level_ends_the_run_with_its_remedy(tmp_path, capsys):
    path = edited(tmp_path, texts={"[sweep]": "[sweep]\ncalibration = false\nlimits = { drive_v = 0.05 }"})
    assert run(["sweep", str(path), "--out", str(tmp_path)]) == 3
    said = capsys.readouterr().err
    assert "of [sweep] level_g, short by" in said
    assert "raise limits.drive_v as far as the shaker allows" in said


def test_faults_are_in_the_json_too_and_a_missing_file_says_who_names_it(tmp_path, capsys):
    write_new("experiment-beam", tmp_path / "e.toml")
    write_new("rig", tmp_path / "rig.toml")
    status, _, err = call(capsys, "check", tmp_path / "e.toml", "--json", tmp_path / "out.json")
    missing = f"{tmp_path / 'specimen.toml'}: no such file, named by specimen = 'specimen.toml' in "
    assert status == 2
    assert missing in err
    found = json.loads((tmp_path / "out.json").read_text())
    assert found["faults"] == [f"{missing}{tmp_path / 'e.toml'}"]
    assert found["segments"] == []
    write_new("beam", tmp_path / "specimen.toml")
    err = call(capsys, "check", tmp_path / "e.toml")[2]
    assert 'expected [simulation] specimen = "specimen.toml" in rig.toml' in err
