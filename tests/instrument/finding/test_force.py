"""Plates driven by a force, through files and commands."""

import json

import numpy as np
import pytest
from plate_files import plate_text

from instrument.cli.main import run
from instrument.files.specimen_file import read_specimen

LAW = "ginf_mpa = 4.0\ntau_s = 1.5e-4\nalpha = 0.8"
FORCED = """
[pickup]
x_mm = 220.0
y_mm = 170.0
[excitation]
kind = "force"
x_mm = 30.0
y_mm = 50.0
"""
FREE = plate_text("free", LAW, (8, 6)) + FORCED
FORCE_N = 2.0 * np.exp(0.3j)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    found = tmp_path_factory.mktemp("force")
    (found / "free.toml").write_text(FREE)
    (found / "start.toml").write_text(FREE.replace("g0_mpa = 0.4", "g0_mpa = 0.55"))
    status = run(
        ["predict", str(found / "free.toml"), "--frequencies", "60:200:4", "--json", str(found / "p.json")]
    )
    assert status == 0
    points = json.loads((found / "p.json").read_text())["points"]
    f = np.array([p["frequency_hz"] for p in points])
    rng = np.random.default_rng(0)
    v = np.array([complex(p["velocity_re_m_s"], p["velocity_im_m_s"]) for p in points])
    v = v * (1 + 1e-3 * (rng.normal(size=len(f)) + 1j * rng.normal(size=len(f))))
    a, x = v * 2j * np.pi * f, v / (2j * np.pi * f)
    write(found / "acceleration.csv", "acceleration_{}_m_s2", f, a * FORCE_N, force=True)
    write(found / "displacement.csv", "displacement_{}_m", f, x * FORCE_N, force=True)
    write(found / "accelerance.csv", "accelerance_{}", f, a)
    write(found / "receptance.csv", "receptance_{}", f, x)
    return found


def write(path, name, f, values, *, force=False):
    header = ["frequency_hz", *(name.format(part) for part in ("re", "im"))]
    columns = [f, values.real, values.imag]
    if force:
        header += ["force_re_n", "force_im_n"]
        columns += [np.full(len(f), FORCE_N.real), np.full(len(f), FORCE_N.imag)]
    np.savetxt(
        path, np.column_stack(columns), delimiter=",", header=",".join(header), comments="", fmt="%.17g"
    )


@pytest.mark.parametrize("data", ["acceleration", "displacement", "accelerance", "receptance"])
def test_a_struck_free_plate_gives_its_law_from_any_reading(folder, capsys, data):
    line = ["identify", str(folder / f"{data}.csv"), "--specimen", str(folder / "start.toml")]
    assert run([*line, "--json", "-"]) == 0
    result = json.loads(capsys.readouterr().out)
    truth = read_specimen(folder / "free.toml").core.law
    for row in result["law"]:
        G = truth.modulus(np.array([2 * np.pi * row["frequency_hz"]]))[0]
        off = abs(row["storage_modulus_pa"] - G.real)
        assert off < 3 * row["storage_modulus_standard_error_pa"]
    names = {a["name"] for a in result["adjusted"]}
    assert {"force_x", "force_y", "pickup_x", "pickup_y"} < names


TWO = FREE.replace("[pickup]", "[[pickup]]").replace(
    "[excitation]", "[[pickup]]\nx_mm = 40.0\ny_mm = 150.0\n[tolerances]\ngain_percent = 3.0\n[excitation]"
)


@pytest.fixture(scope="module")
def two_spots(folder):
    """The second spot read 3 % too high."""
    (folder / "two.toml").write_text(TWO)
    line = [
        "predict",
        str(folder / "two.toml"),
        "--frequencies",
        "60:200:4",
        "--json",
        str(folder / "2.json"),
    ]
    assert run(line) == 0
    points = json.loads((folder / "2.json").read_text())["points"]
    assert [p["pickup"] for p in points] == [0] * 36 + [1] * 36
    rng = np.random.default_rng(3)
    rows = ["pickup,frequency_hz,mobility_re,mobility_im"]
    for p in points:
        v = complex(p["velocity_re_m_s"], p["velocity_im_m_s"]) * (1 + 0.03 * p["pickup"])
        v *= 1 + 1e-3 * complex(*rng.normal(size=2))
        rows.append(f"{p['pickup']},{p['frequency_hz']},{v.real!r},{v.imag!r}")
    (folder / "two.csv").write_text("\n".join(rows))
    return folder


def test_spots_are_fitted_together_each_with_its_own_gain_and_place(two_spots, capsys):
    line = ["identify", str(two_spots / "two.csv"), "--specimen", str(two_spots / "two.toml")]
    assert run([*line, "--json", "-"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert {p["pickup"] for p in result["points"]} == {0, 1}
    found = {a["name"]: a for a in result["adjusted"]}
    assert {"gain [pickup 0]", "pickup_x [pickup 1]", "force_x", "length"} < set(found)
    apart = found["gain [pickup 1]"]["found"] - found["gain [pickup 0]"]["found"]
    assert apart == pytest.approx(0.03, abs=6e-3)
    truth = read_specimen(two_spots / "free.toml").core.law
    row = next(r for r in result["law"] if r["frequency_hz"] == 100.0)
    G = truth.modulus(np.array([2 * np.pi * 100.0]))[0]
    assert abs(row["storage_modulus_pa"] - G.real) < 3 * row["storage_modulus_standard_error_pa"]


@pytest.mark.long
def test_several_spots_have_a_budget_and_profiles(two_spots, capsys):
    line = ["identify", str(two_spots / "two.csv"), "--specimen", str(two_spots / "two.toml"), "--budget"]
    assert run([*line, "--uncertainty", "profile", "--json", "-"]) == 0
    result = json.loads(capsys.readouterr().out)
    sources = {s["source"] for s in result["budget"][0]["sources"]}
    assert {"noise", "gain [pickup 0]", "gain [pickup 1]", "core_thickness"} < sources
    (looked,) = result["uncertainty"]
    row = next(r for r in result["law"] if r["frequency_hz"] == 100.0)
    at = next(q for q in looked["quantities"] if q["quantity"] == "storage_modulus_pa at 100 Hz")
    half = (at["interval_68_percent"][1] - at["interval_68_percent"][0]) / 2
    assert half == pytest.approx(row["storage_modulus_standard_error_pa"], rel=0.2)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--uncertainty", "bootstrap"], "expected profile"),
        (["--pointwise"], "read at one spot"),
        (["--method", "paper"], "read at one spot"),
    ],
)
def test_what_several_spots_do_not_have_is_refused(two_spots, capsys, options, said):
    line = ["identify", str(two_spots / "two.csv"), "--specimen", str(two_spots / "two.toml")]
    assert run([*line, *options]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda text: text.replace("pickup,", "spot,"), "column pickup missing"),
        (lambda text: text.replace("\n1,", "\n2,"), "column pickup: 2, expected 0 to 1"),
    ],
)
def test_rows_say_which_spot_they_are_of(two_spots, tmp_path, capsys, change, said):
    text = change((two_spots / "two.csv").read_text())
    if "spot," in text:
        text = "\n".join(line for line in text.splitlines() if not line.startswith("1,"))
    (tmp_path / "bad.csv").write_text(text)
    assert run(["identify", str(tmp_path / "bad.csv"), "--specimen", str(two_spots / "two.toml")]) == 2
    assert said in capsys.readouterr().err


def test_rows_of_one_spot_are_an_ordinary_sweep(two_spots, tmp_path, capsys):
    rows = (two_spots / "two.csv").read_text().splitlines()
    (tmp_path / "one.csv").write_text("\n".join([rows[0], *(r for r in rows if r.startswith("1,"))]))
    line = ["identify", str(tmp_path / "one.csv"), "--specimen", str(two_spots / "two.toml"), "--json", "-"]
    assert run(line) == 0
    result = json.loads(capsys.readouterr().out)
    found = {a["name"]: a["stated"] for a in result["adjusted"]}
    assert (found["pickup_x"], found["pickup_y"]) == (40.0, 150.0)


def test_an_effect_of_the_base_cannot_be_accepted_where_a_force_drives(folder, capsys):
    line = ["diagnose", str(folder / "accelerance.csv"), "--specimen", str(folder / "free.toml")]
    assert run([*line, "--accept", "base_rocking"]) == 2
    said = capsys.readouterr().err
    assert "base_rocking" in said
    assert "driven by a force" in said
    assert "Traceback" not in said
