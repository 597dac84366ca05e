"""Plates driven by a force, through files and commands."""

import json

import numpy as np
import pytest

from instrument.cli.main import run
from instrument.files.specimen_file import read_specimen

FREE = """
[plate]
length_mm = 300.0
width_mm = 200.0
boundary = "free"
[substrate]
thickness_mm = 2.0
young_gpa = 69.0
poisson = 0.3
density_kg_m3 = 2700.0
[constraining]
thickness_mm = 0.5
young_gpa = 69.0
poisson = 0.3
density_kg_m3 = 2700.0
[core]
thickness_mm = 0.5
poisson = 0.49
density_kg_m3 = 1000.0
[core.law]
kind = "fractional-zener"
g0_mpa = 0.4
ginf_mpa = 4.0
tau_s = 1.5e-4
alpha = 0.8
[mesh]
elements_x = 14
elements_y = 10
[pickup]
x_mm = 220.0
y_mm = 170.0
[excitation]
kind = "force"
x_mm = 30.0
y_mm = 50.0
"""
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


def test_an_effect_of_the_base_cannot_be_accepted_where_a_force_drives(folder, capsys):
    line = ["diagnose", str(folder / "accelerance.csv"), "--specimen", str(folder / "free.toml")]
    assert run([*line, "--accept", "base_rocking"]) == 2
    said = capsys.readouterr().err
    assert "base_rocking" in said
    assert "driven by a force" in said
    assert "Traceback" not in said
