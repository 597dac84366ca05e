"""Cores that a layer-wise plate does not describe are refused in one line, whatever the fit looks like."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from beam_cases import BEAM
from paper_law import TABLE_4
from rig_plate import plate_of_the_rig

from fitting.errors import OutsideModel
from fitting.laws.constant import ConstantModulus
from fitting.sweep import Sweep
from instrument.cli.main import run
from instrument.files.structure_file import read_structure
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.finding.methods import DirectMethod
from instrument.models.files import File
from instrument.models.specimen_models import Models
from instrument.paper_case import case_file
from instrument.progress import quiet
from instrument.remarks.theory import check_each_theory, stiffer_than_stated, theory_remark
from instrument.results.identification_from import identification_from

F = np.concatenate([np.linspace(a, b, 12) for a, b in ((14, 24), (80, 110), (230, 290))])
SEGMENT = np.repeat([1, 2, 3], 12)


def sweep_of(specimen):
    """What the plate model itself gives: it fits perfectly."""
    v = Models.of(specimen, F).predict(specimen.core.law, F)
    return Sweep(
        frequency_hz=F,
        velocity_m_s=v,
        commanded_m_s2=np.full(len(F), specimen.base_acceleration_m_s2),
        segment=SEGMENT,
        sweep=np.ones(len(F), dtype=np.intp),
        std_m_s=2e-3 * np.abs(v),
        time_s=np.arange(float(len(F))),
    )


def soft(specimen):
    return specimen.with_law(ConstantModulus(g_pa=0.01e6, loss_factor=0.5))


def thick_and_soft(specimen):
    law = ConstantModulus(g_pa=0.05e6, loss_factor=0.5)
    return replace(specimen, core=replace(specimen.core, thickness_m=5e-3, law=law))


@pytest.mark.parametrize("make", [soft, thick_and_soft])
def test_identify_refuses_in_one_line(coarse, make):
    specimen = make(coarse)
    with pytest.raises(OutsideModel, match=r"plate theory at .* Hz: .* exact elasticity \(limit") as refused:
        identify([File(sweep_of(specimen), specimen)])
    assert "\n" not in str(refused.value)
    assert "nor does the fit follow" not in str(refused.value)


def test_a_fit_that_is_lost_besides_says_so(coarse):
    specimen = soft(coarse)
    sweep = sweep_of(specimen)
    lost = SimpleNamespace(law=specimen.core.law, velocity_m_s=2 * sweep.velocity_m_s)
    with pytest.raises(OutsideModel, match=r"plate theory at .* check units, level and pickup"):
        DirectMethod(File(sweep, specimen), specimen, None, quiet).theory(lost)


def test_diagnose_refuses_the_law_it_ends_with(coarse):
    specimen = soft(coarse)
    with pytest.raises(OutsideModel, match="plate theory"):
        diagnose([File(sweep_of(specimen), specimen)], accept=())


def test_a_usual_core_is_identified_and_its_error_stated(coarse):
    sweep = sweep_of(coarse.with_law(TABLE_4))
    found = identify([File(sweep, coarse)])
    rows = identification_from(found).theory_error
    assert len(rows) == 10
    assert set(rows[0].as_json()) == {"frequency_hz", "frequency_error", "loss_factor_error"}
    assert (rows[0].frequency_hz, rows[-1].frequency_hz) == (pytest.approx(14), pytest.approx(290))
    assert all(0 < r.frequency_error < 1e-3 for r in rows)


def test_predict_notes_it(capsys, tmp_path):
    usual, soft = tmp_path / "usual.toml", tmp_path / "soft.toml"
    text = case_file("zn1.toml").read_text() + "\n[mesh]\nelements_x = 10\nelements_y = 10\n"
    usual.write_text(text)
    soft.write_text(
        text.replace("g0_mpa = 0.40268", "g0_mpa = 0.01").replace("ginf_mpa = 4.1946", "ginf_mpa = 0.01")
    )
    notes = []
    for specimen in (soft, usual):
        assert run(["predict", str(specimen), "--frequencies", "20,300", "--json", "-"]) == 0
        notes.append(json.loads(capsys.readouterr().out)["notes"])
    assert [len(n) for n in notes] == [1, 0]
    assert "plate theory at 300 Hz" in notes[0][0]


def test_a_bare_plate_has_nothing_to_refuse(coarse):
    assert not theory_remark(coarse.bare, None, F)


def test_the_command_ends_with_2(capsys, tmp_path, coarse):
    specimen = tmp_path / "thick.toml"
    text = (
        case_file("zn1.toml")
        .read_text()
        .split("[core.law]")[0]
        .replace("thickness_mm = 0.5", "thickness_mm = 5.0")
    )
    text += (
        '[core.law]\nkind = "constant"\ng_mpa = 0.05\nloss_factor = 0.5\n[pickup]\nx_mm = 60.0\ny_mm = 60.0\n'
    )
    specimen.write_text(text + "[mesh]\nelements_x = 10\nelements_y = 10\n[tolerances]\nexact = true\n")
    sweep, data = sweep_of(thick_and_soft(coarse)), tmp_path / "sweep.csv"
    rows = [
        f"{f},{v.real},{v.imag},{abs(v) * 2e-3},{s}"
        for f, v, s in zip(F, sweep.velocity_m_s, SEGMENT, strict=True)
    ]
    head = "frequency_hz,velocity_re_m_s,velocity_im_m_s,velocity_std_m_s,segment"
    data.write_text("\n".join([head, *rows]) + "\n")
    status = run(["identify", str(data), "--specimen", str(specimen), "--json", "-"])
    captured = capsys.readouterr()
    assert (status, captured.out) == (2, "")
    assert captured.err.count("\n") == 1
    assert "plate theory" in captured.err


def a_beam(tmp_path, thicker=1.0):
    """Its faces so many times as thick."""
    (tmp_path / "beam.toml").write_text(BEAM)
    beam = read_structure(tmp_path / "beam.toml")
    assert beam.constraining is not None
    faces = {
        name: replace(face, thickness_m=thicker * face.thickness_m)
        for name, face in (("substrate", beam.substrate), ("constraining", beam.constraining))
    }
    return replace(beam, **faces)


def notes_of(beam, g_pa, from_hz=50.0):
    law = ConstantModulus(g_pa=g_pa, loss_factor=0.5)
    return check_each_theory([beam], law, [np.array([from_hz, 2500.0])])


def test_faces_of_a_beam_that_shear_are_in_its_theory(tmp_path):
    thick = a_beam(tmp_path, thicker=6.0)
    assert "the faces shear" in theory_remark(
        thick.as_plate, ConstantModulus(g_pa=5e7, loss_factor=0.5), np.array([50.0, 2500.0])
    )
    assert notes_of(thick, 5e7) == ()


def test_a_core_of_a_beam_that_stretches_is_said_with_where_it_begins(tmp_path):
    (note,) = notes_of(a_beam(tmp_path, thicker=3.0), 5e5)
    assert note.startswith("beam theory at 2500 Hz: ")
    assert "the core stretches across its thickness" in note
    assert "resonances above" in note


def test_a_beam_whose_core_stretches_everywhere_is_refused(tmp_path):
    with pytest.raises(OutsideModel, match="beam theory at"):
        notes_of(a_beam(tmp_path, thicker=3.0), 1e4, from_hz=1000.0)


def test_a_core_that_turns_out_stiffer_than_stated_is_said_to_shear_its_faces():
    plate, f = plate_of_the_rig(), np.array([20.0, 280.0])
    assert stiffer_than_stated(plate, ConstantModulus(1e6, 0.5), f) == ""
    said = stiffer_than_stated(plate, ConstantModulus(2e8, 0.0), f)
    assert said.startswith("core of 200 MPa: its faces take ")
    assert "write the law found into [core.law]" in said
    assert stiffer_than_stated(replace(plate, faces_shear=True), ConstantModulus(2e8, 0.0), f) == ""
