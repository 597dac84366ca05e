"""The standards' formulas beside the full model, on tables of beams."""

import json
from dataclasses import replace

import numpy as np
import pytest

from fitting.errors import OutsideModel
from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.formulas import by_formula
from fitting.mode_tables.table import ModalTable
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small_modes import small_modes
from instrument.cli.main import run

STEEL = Face(1e-3, 205e9, 0.29, 7850.0)
LAW = ConstantModulus(1e9, 0.05)
OBERST = Beam(0.2, 0.01, "clamped-free", STEEL, core=Core(1.5e-3, 0.4, 1300.0, LAW), slender=True)


def table_of(beam, law, count=4):
    modes = small_modes(beam, law, count)
    return ModalTable(
        np.arange(1.0, count + 1),
        np.array([m.frequency_hz for m in modes]),
        np.array([max(m.loss_factor, 1e-4) for m in modes]),
    )


BARE = table_of(replace(OBERST, core=None), None)


def test_oberst_gives_the_layer_s_shear_modulus_back():
    found = by_formula(table_of(OBERST, LAW), OBERST, LAW, BARE)
    assert {one.method for one in found} == {"oberst"}
    for one in found:
        assert one.storage_modulus_pa == pytest.approx(1e9, rel=3e-3)
        assert one.loss_factor == pytest.approx(0.05, rel=5e-3)
        assert (one.full_storage_modulus_pa, one.full_loss_factor) == (1e9, 0.05)
        assert bool(one.objections) == (one.mode == 1)


def test_unequal_faces_are_objected_to():
    core = Core(0.25e-3, 0.49, 1000.0, ConstantModulus(1e6, 0.3))
    beam = Beam(0.2, 0.01, "clamped-free", STEEL, replace(STEEL, thickness_m=0.5e-3), core)
    found = by_formula(table_of(beam, core.law), beam, core.law, BARE)
    assert found
    assert all("two equal faces" in " ".join(one.objections) for one in found)


def test_a_centre_driven_beam_has_its_bending_stiffness():
    beam = replace(OBERST, boundary="centre-driven", core=None)
    found = by_formula(table_of(beam, None), beam, LAW)
    assert found
    for one in found:
        assert one.method == "central-impedance"
        assert one.bending_stiffness_n_m2 == pytest.approx(205e9 * 0.01 * 1e-9 / 12, rel=2e-3)


def test_no_formula_without_a_bare_beam_and_none_for_other_ends():
    assert by_formula(table_of(OBERST, LAW), OBERST, LAW) == ()
    free = replace(OBERST, boundary="free-free")
    with pytest.raises(OutsideModel, match="clamped-free"):
        by_formula(table_of(OBERST, LAW), free, LAW, BARE)


FILE = """
[beam]
length_mm = 200.0
width_mm = 10.0
boundary = "clamped-free"
[substrate]
thickness_mm = 1.0
young_gpa = 205.0
poisson = 0.29
density_kg_m3 = 7850.0
[core]
thickness_mm = 1.5
poisson = 0.4
density_kg_m3 = 1300.0
[core.law]
kind = "constant"
g_mpa = 800.0
loss_factor = 0.1
"""


def written(path, table):
    rows = zip(table.mode, table.frequency_hz.tolist(), table.loss_factor.tolist(), strict=True)
    path.write_text("mode,frequency_hz,loss_factor\n" + "".join(f"{n:.0f},{f!r},{e!r}\n" for n, f, e in rows))


def test_identify_shows_both_and_says_what_speaks_against_the_formula(tmp_path, capsys):
    (tmp_path / "beam.toml").write_text(FILE)
    written(tmp_path / "treated.csv", table_of(OBERST, LAW))
    written(tmp_path / "bare.csv", BARE)
    words = ["identify", str(tmp_path / "treated.csv"), "--specimen", str(tmp_path / "beam.toml")]
    assert run([*words, "--bare", str(tmp_path / "bare.csv"), "--json", str(tmp_path / "out.json")]) == 0
    said = capsys.readouterr().out
    assert "by formula, mode by mode (ASTM E756, oberst)" in said
    assert "the standard leaves the first mode out" in said
    rows = json.loads((tmp_path / "out.json").read_text())["formulas"]
    assert [row["mode"] for row in rows] == [1, 2, 3, 4]
    assert rows[1]["storage_modulus_pa"] == pytest.approx(rows[1]["full_storage_modulus_pa"], rel=0.02)
    (tmp_path / "sweep.csv").write_text("frequency_hz,velocity_m_s\n10,1\n")
    words[1] = str(tmp_path / "sweep.csv")
    assert run([*words, "--bare", str(tmp_path / "bare.csv")]) == 2
    assert "--bare" in capsys.readouterr().err
