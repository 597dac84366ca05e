"""The commands as a user calls them, their JSON to the letter."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from called import call, facts
from data_folder import DATA
from result_cases import IDENTIFY_KEYS

from instrument.cli.main import COMMANDS
from instrument.paper_case import case_file

ZN1, TABLE5 = str(case_file("zn1.toml")), str(case_file("table5.csv"))


@pytest.fixture(scope="module")
def plate(tmp_path_factory):
    """The same on the paper's mesh, for what is said of any plate."""
    path = tmp_path_factory.mktemp("plate") / "coarse.toml"
    path.write_text(Path(ZN1).read_text() + "\n[mesh]\nelements_x = 10\nelements_y = 10\n")
    return path


def test_modes_gives_as_many_modes_as_asked_for_in_order(capsys, plate):
    found = facts(capsys, "modes", plate, "--count", 3)["modes"]
    assert len(found) == 3
    assert set(found[0]) == {"frequency_hz", "loss_factor"}
    assert [m["frequency_hz"] for m in found] == sorted(m["frequency_hz"] for m in found)


def test_modes_of_a_bare_plate(capsys, tmp_path):
    text = re.sub(r"\[constraining\].*?\[damping\]", "[damping]", Path(ZN1).read_text(), flags=re.S)
    path = tmp_path / "bare.toml"
    path.write_text(text)
    found = facts(capsys, "modes", path, "--count", 2)["modes"]
    np.testing.assert_allclose([m["frequency_hz"] for m in found], [17.72, 59.8], rtol=3e-3)
    assert found[0]["loss_factor"] == 0


def test_modes_say_where_plate_theory_does_not_hold(capsys, plate, tmp_path):
    thick = tmp_path / "thick.toml"
    thick.write_text(re.sub(r"(\[core\]\s+thickness_mm = )[\d.]+", r"\g<1>50.0", plate.read_text()))
    assert facts(capsys, "modes", plate)["notes"] == []
    (note,) = facts(capsys, "modes", thick, "--force")["notes"]
    assert "above exact elasticity (limit 0.5 %)" in note
    assert f"note: {note}" in call(capsys, "modes", thick, "--force")[1]


def test_predict_gives_a_point_for_each_frequency_asked_for(capsys, plate):
    points = facts(capsys, "predict", plate, "--frequencies", "18.4:20.2:0.9")["points"]
    np.testing.assert_allclose([p["frequency_hz"] for p in points], [18.4, 19.3, 20.2])
    for p in points:
        assert p["velocity_m_s"] == pytest.approx(np.hypot(p["velocity_re_m_s"], p["velocity_im_m_s"]))


def test_predict_range_includes_its_end(capsys, plate):
    points = facts(capsys, "predict", plate, "--frequencies", "10:11:0.3")["points"]
    np.testing.assert_allclose([p["frequency_hz"] for p in points], [10, 10.3, 10.6, 10.9, 11])


def test_absolute_reading_adds_the_base(capsys, plate, tmp_path):
    path = tmp_path / "absolute.toml"
    path.write_text(plate.read_text().replace("y_mm = 60.0", 'y_mm = 60.0\nreads = "absolute"'))
    relative, absolute = (
        facts(capsys, "predict", p, "--frequencies", "19.3")["points"][0] for p in (plate, path)
    )
    base = 9.81 / (1j * 2 * np.pi * 19.3)
    assert absolute["velocity_im_m_s"] - relative["velocity_im_m_s"] == pytest.approx(base.imag)
    assert absolute["velocity_re_m_s"] == pytest.approx(relative["velocity_re_m_s"])


def test_real_modes_differ_from_the_full_equation(capsys, plate):
    full, real = (
        facts(capsys, "predict", plate, "--frequencies", "19.3", *more)["points"][0]["velocity_m_s"]
        for more in ((), ("--real-modes",))
    )
    assert 0.002 < abs(real / full - 1) < 0.1


def test_uncertified_points_are_solved_in_full(capsys, plate, tmp_path, zn1, monkeypatch):
    from instrument.models import specimen_models as models

    plain = facts(capsys, "predict", plate, "--frequencies", "19.3,101")["points"]
    monkeypatch.setattr(models, "CERTIFIED", 0.0)
    solved = facts(capsys, "predict", plate, "--frequencies", "19.3,101")["points"]
    for a, b in zip(plain, solved, strict=True):
        assert a["velocity_m_s"] == pytest.approx(b["velocity_m_s"], rel=1e-6)
        assert a != b


@pytest.mark.parametrize("method", ["direct", "paper"])
def test_identify_table_5(capsys, plate, method):
    found = facts(capsys, "identify", TABLE5, "--specimen", plate, "--method", method)
    assert set(found) >= IDENTIFY_KEYS
    assert set(found["parameters"]) == {"g0_pa", "ginf_pa", "tau_s", "alpha"}
    assert set(found["standard_errors"]) == set(found["parameters"])
    assert len(found["points"]) == 9
    difference = [p["difference_percent"] for p in found["points"]]
    for p in found["points"]:
        expected = 100 * (p["predicted_m_s"] - p["measured_m_s"]) / p["measured_m_s"]
        assert p["difference_percent"] == pytest.approx(expected)
    assert found["rms_percent"] == pytest.approx(np.sqrt(np.mean(np.square(difference))))
    assert found["max_percent"] == pytest.approx(np.max(np.abs(difference)))
    assert found["criterion_met"] is (False if method == "paper" else None)
    assert found["held_out"] == []
    assert {20, 100, 280} <= {row["frequency_hz"] for row in found["law"]}
    low, high = found["law"][0]["frequency_hz"], found["law"][-1]["frequency_hz"]
    assert (low, high) == (pytest.approx(18.4), pytest.approx(295.2))
    limit = {"direct": 5.4, "paper": 6.2}[method]
    assert found["rms_percent"] < limit


def test_identify_a_dense_sweep_holds_segments_out(capsys, plate):
    found = facts(capsys, "identify", DATA / "practice-002.csv", "--specimen", plate)
    assert [h["segment"] for h in found["held_out"]] == [1, 2, 3]
    assert set(found["held_out"][0]) == {"segment", "rms_percent", "noise_percent"}
    assert found["leave_one_out_rms_percent"] is None
    assert found["held_out_rms_percent"] > 0


def test_without_the_viscous_damping_the_core_seems_lossier(capsys, plate):
    with_it, without = (
        facts(capsys, "identify", TABLE5, "--specimen", plate, *more)["law"][1]["loss_factor"]
        for more in ((), ("--no-viscous-damping",))
    )
    assert without > with_it


def test_core_far_from_the_start_widens_the_domain(capsys, plate, tmp_path):
    # A core 100 times stiffer than the default domain's middle, found from the paper's start.
    stiff = plate.read_text()
    stiff = re.sub(
        r"\[core\.law\].*?\n\n",
        '[core.law]\nkind = "constant"\ng_mpa = 60.0\nloss_factor = 0.4\n\n',
        stiff,
        flags=re.S,
    )
    (tmp_path / "stiff.toml").write_text(stiff)
    (tmp_path / "soft.toml").write_text(stiff.replace("g_mpa = 60.0", "g_mpa = 5.0"))
    points = facts(capsys, "predict", tmp_path / "stiff.toml", "--frequencies", "20:60:2")["points"]
    rows = [f"{p['frequency_hz']},{p['velocity_re_m_s']:.9g},{p['velocity_im_m_s']:.9g}" for p in points]
    header = "frequency_hz,velocity_re_m_s,velocity_im_m_s"
    (tmp_path / "sweep.csv").write_text("\n".join([header, *rows]))
    found = facts(capsys, "identify", tmp_path / "sweep.csv", "--specimen", tmp_path / "soft.toml")
    assert found["parameters"]["g_pa"] == pytest.approx(60e6, rel=1e-2)
    assert found["parameters"]["loss_factor"] == pytest.approx(0.4, rel=1e-2)


def test_json_to_a_file_holds_the_same_facts(capsys, plate, tmp_path):
    path = tmp_path / "modes.json"
    status, out, _ = call(capsys, "modes", plate, "--count", 1, "--json", path)
    assert status == 0
    f = json.loads(path.read_text())["modes"][0]["frequency_hz"]
    assert f"{f:.3f}" in out


@pytest.mark.long
def test_demo_identifies_and_draws(capsys, tmp_path):
    status, out, err = call(capsys, "demo", "--out", tmp_path / "out")
    assert status == 0, err
    assert "Table 5 beside the published theory" in out
    names = {p.name for p in (tmp_path / "out").iterdir()}
    assert names >= {
        "fig06-two-dampings.png",
        "fig09-response.png",
        "fig10-material.png",
        "identify-direct.json",
    }
    for path in (tmp_path / "out").glob("*.png"):
        assert path.stat().st_size > 1000
    assert "what was found beside the simulated plate's own law" in out
    # The published case ends with the one result that `diagnose` prints of the same files.
    assert out.splitlines()[-1].startswith("result: 20 Hz: G' 0.288 +- 0.044 MPa")
    (session,) = (tmp_path / "out").glob("*.h5")
    assert session.with_suffix(".html").exists()
    run = json.loads((tmp_path / "out" / "run.json").read_text())
    assert run["session"] == str(session)
    assert run["identify"]["converged"]


SPECIMEN = Path(ZN1).read_text()
ONE_POINT = "frequency_hz,velocity_m_s\n19.3,0.1\n"


def bad_calls(tmp_path):
    """Command lines that must be refused, each with a word its line must hold."""

    def file(name, text):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    no_pickup = re.sub(r"\[pickup\].*?\n\n", "", SPECIMEN, flags=re.S)
    bare = re.sub(r"\[constraining\].*?\[damping\]", "[damping]", SPECIMEN, flags=re.S)
    isd = case_file("isd112.toml")
    return [
        (["identify", tmp_path / "none.csv", "--specimen", ZN1], "none.csv"),
        (["identify", file("empty.csv", ""), "--specimen", ZN1], "empty"),
        (["identify", file("one.csv", ONE_POINT), "--specimen", ZN1], "1 point"),
        (["identify", file("one.csv", ONE_POINT), "--specimen", ZN1, "--method", "paper"], "1 point"),
        (["identify", file("binary.csv", b"\xff\x00\x01"), "--specimen", ZN1], "binary.csv"),
        (["identify", TABLE5], "--specimen"),
        (["identify", TABLE5, "--specimen", ZN1, "--method", "guess"], "guess"),
        (["identify", TABLE5, "--specimen", file("bare.toml", bare)], "no core"),
        (["identify", TABLE5, "--specimen", isd], "no parameter"),
        (["identify", TABLE5, "--specimen", file("np.toml", no_pickup)], "[pickup] is missing"),
        (["identify", TABLE5, "--specimen", ZN1, "--json", tmp_path / "no" / "x.json"], "x.json"),
        (["predict", ZN1, "--frequencies", "0,10"], "0,10"),
        (["predict", ZN1, "--frequencies", "-5"], "-5"),
        (["predict", ZN1, "--frequencies", "10:5:1"], "10:5:1"),
        (["predict", ZN1, "--frequencies", "1:2:0"], "1:2:0"),
        (["predict", ZN1, "--frequencies", "nan"], "nan"),
        (["predict", ZN1, "--frequencies", "1:1e9:0.1"], "1:1e9:0.1"),
        (["predict", ZN1, "--frequencies", "ten"], "ten"),
        (["predict", ZN1, "--frequencies", "90000"], "mesh"),
        (["predict", ZN1], "--frequencies"),
        (["predict", isd, "--frequencies", "0.5,20"], "1 Hz or more"),
        (
            ["predict", file("free.toml", SPECIMEN.replace("cantilever", "free")), "--frequencies", "20"],
            "no base",
        ),
        (["modes", ZN1, "--count", "0"], "count"),
        (["modes", tmp_path], str(tmp_path)),
        (["demo", "--out", file("taken", "a file")], "taken"),
        (["nonsense"], "nonsense"),
        (["modes", ZN1, "--nonsense"], "nonsense"),
    ]


@pytest.mark.parametrize("k", range(27))
def test_bad_call_gets_one_line_and_status_2(capsys, tmp_path, k):
    arguments, expected = bad_calls(tmp_path)[k]
    status, out, err = call(capsys, *arguments)
    assert status == 2
    assert err.startswith("viscorig: ")
    assert err.count("\n") == 1
    assert expected in err
    assert out == ""


def test_every_bad_call_is_tried(tmp_path):
    assert len(bad_calls(tmp_path)) == 27


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(capsys, command):
    status, out, _ = call(capsys, command, "--help")
    assert status == 0
    assert out.startswith("Usage: viscorig")


def test_stopped_by_the_user_is_130(capsys, monkeypatch):
    import instrument.cli.modes as module

    def stop(path):
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "read_structure", stop)
    status, _, err = call(capsys, "modes", ZN1)
    assert status == 130
    assert "Traceback" not in err


def test_a_pipe_sees_no_progress(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "viscorig", "modes", ZN1, "--count", "1"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""
    assert "20.2" in done.stdout
