"""Files of other programs and tables of modes: what is read of them, and how a wrong one is refused."""

import re

import numpy as np
import pytest
from scipy.io import savemat
from uff_files import ratio_set, write_sets

from instrument.errors import BadInput
from instrument.files.lvm import read_lvm
from instrument.files.mat import read_mat_variables
from instrument.files.modal_table import is_modal_table, read_modal_table
from instrument.files.plausible import INSIST, question_specimen, specimen_doubts
from instrument.files.sweep_file import read_sweep
from instrument.files.uff58 import FRF, read_uff58

LVM = """LabVIEW Measurement
Separator	Tab
Decimal_Separator	,
X_Columns	One
***End_of_Header***
Channels	2
Samples	8	8
Y_Unit_Label	N	m/s^2
Delta_X	0,002	0,002
***End_of_Header***
X_Value	force	tip
"""
SAMPLES = "".join(f"0,0\t{k},5\t-{k}\n" for k in range(16))


def written(tmp_path, text, name="a.lvm"):
    path = tmp_path / name
    path.write_text(text)
    return path


def test_labview_s_text_is_read_with_decimal_commas_segment_by_segment(tmp_path):
    first, second = read_lvm(written(tmp_path, LVM + SAMPLES))
    assert (first.names, first.units, first.sample_rate_hz) == (("force", "tip"), ("N", "m/s^2"), 500.0)
    assert first.samples[:, 0] == pytest.approx(np.arange(8) + 0.5)
    assert second.samples[:, 1] == pytest.approx(-np.arange(8.0, 16.0))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("LabVIEW", "Lab", "line 1: expected 'LabVIEW Measurement'"),
        ("Delta_X\t0,002", "Delta_X\t-1", "Delta_X = -1, expected more than 0"),
        ("Channels\t2", "Channels\t9", "9 channels"),
        ("0,0\t3,5", "0,0\tthree", "line 15: .*expected 2 numbers"),
    ],
)
def test_text_that_is_none_is_refused_at_its_line(tmp_path, old, new, said):
    with pytest.raises(BadInput, match=said):
        read_lvm(written(tmp_path, (LVM + SAMPLES).replace(old, new, 1)))


def test_matlab_s_variables_come_by_name_and_what_is_none_is_refused(tmp_path):
    savemat(tmp_path / "a.mat", {"f_hz": [[1.0], [2.0]], "said": {"unit": "m/s"}})
    found = read_mat_variables(tmp_path / "a.mat")
    assert found["f_hz"].tolist() == [1.0, 2.0]
    assert found["said"] == {"unit": "m/s"}
    assert set(found) == {"f_hz", "said"}
    with pytest.raises(BadInput, match="not a MATLAB file"):
        read_mat_variables(written(tmp_path, "no", "b.mat"))


def test_a_universal_file_s_ratio_is_read_with_its_frequencies(tmp_path):
    f, H = np.array([10.0, 12.0, 15.0]), np.array([1 + 1j, 2.0, -1j])
    write_sets(tmp_path / "a.uff", ratio_set(f, H, 11, 12))
    (found,) = read_uff58(tmp_path / "a.uff").functions
    assert (found.kind, found.level_m_s2, found.place) == (FRF, None, None)
    assert found.x == pytest.approx(f)
    assert found.values == pytest.approx(H)


def test_a_table_of_modes_is_known_by_its_header_and_its_modes_ascend(tmp_path):
    head = "mode,frequency_hz,loss_factor,temperature_c\n"
    path = written(tmp_path, head + "2,30,0.1,-5\n1,10,0.2,20\n", "modes.csv")
    assert is_modal_table(path)
    assert not is_modal_table(written(tmp_path, "frequency_hz,velocity_m_s\n1,2\n", "sweep.csv"))
    table = read_modal_table(path)
    assert table.mode.tolist() == [2, 1]
    assert table.temperature_c.tolist() == [-5, 20]
    assert table.frequency_std_hz is None
    for rows, said in (
        ("1,10,0.2,20\n1,30,0.1,20\n", "mode 1 stands twice"),
        ("1,30,0.2,20\n2,10,0.1,20\n", "mode 2 lies below an earlier one"),
        ("1.5,30,0.2,20\n", "line 2: mode = 1.5, expected a whole number"),
        ("1,30,-0.2,20\n", "line 2: loss_factor = -0.2, expected more than 0"),
    ):
        with pytest.raises(BadInput, match=re.escape(said)):
            read_modal_table(written(tmp_path, head + rows, "modes.csv"))


def test_a_number_a_unit_away_is_questioned_with_the_unit_it_would_be_usual_in(tmp_path):
    (doubt,) = specimen_doubts({"substrate": {"young_gpa": 69_000, "thickness_mm": 1.9}})
    assert doubt.startswith("substrate.young_gpa = 69000 is outside 0.5 to 700")
    assert doubt.endswith("is it in MPa?")
    (doubt,) = specimen_doubts({"damping": {"modal_percent": [30.0, 1.0]}})
    assert "100 times less?" in doubt
    assert specimen_doubts({"substrate": {"young_gpa": 69.0}}) == []
    (doubt,) = specimen_doubts({"base": {"acceleration_m_s2": 981.0}})
    assert doubt.endswith("is it in cm/s^2 or mm/s^2?")
    (doubt,) = specimen_doubts({"core": {"poisson": -0.2, "density_kg_m3": 1000.0}})
    assert "rubber has 0.45 to 0.5" in doubt
    assert specimen_doubts({"core": {"poisson": 0.0, "density_kg_m3": 180.0}}) == []
    (doubt,) = specimen_doubts({"glue": [{"shear_mpa": 400.0}, {"shear_mpa": 0.3}]})
    assert doubt.startswith("glue.shear_mpa = 0.3 is outside 2 to 20000")
    assert doubt.endswith("is it in GPa?")
    path = written(tmp_path, "[plate]\nlength_mm = 0.3\n", "plate.toml")
    question_specimen(path, insist=True)
    with pytest.raises(BadInput, match=INSIST):
        question_specimen(path)


def test_a_mesh_that_takes_minutes_and_all_memory_is_questioned_before_any_work():
    (doubt,) = specimen_doubts({"mesh": {"elements_x": 200, "elements_y": 200}})
    assert doubt.startswith("mesh of 200 x 200 elements, a response of which takes some 21 min and 64 GB")
    # Lines across a strip are short, however many there are.
    for x, y in ((80, 80), (400, 20), (10, 10)):
        assert specimen_doubts({"mesh": {"elements_x": x, "elements_y": y}}) == []


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("frequency_sd", "frequency_std_hz"),
        ("frequency_std_Hz", "frequency_std_hz"),
        ("frequency_error_hz", "frequency_std_hz"),
        ("loss_factor_sd", "loss_factor_std"),
        ("eta_std", "loss_factor_std"),
        ("los_factor_std", "loss_factor_std"),
        ("temperature_k", "temperature_c"),
        ("temp_c", "temperature_c"),
    ],
)
def test_an_optional_column_of_modes_by_another_name_is_not_passed_over(tmp_path, name, meant):
    path = written(tmp_path, f"mode,frequency_hz,loss_factor,{name}\n1,10,0.2,0.1\n", "modes.csv")
    with pytest.raises(BadInput, match=f"column {name} is unknown, the nearest is {meant}"):
        read_modal_table(path)


@pytest.mark.parametrize(
    "name", ["note", "loss_factor_fit", "loss_factor_2", "frequency_fem_hz", "mode_shape"]
)
def test_a_column_of_somebody_s_own_stays_in_a_table_of_modes(tmp_path, name):
    path = written(tmp_path, f"mode,frequency_hz,loss_factor,{name}\n1,10,0.2,0.1\n", "modes.csv")
    assert len(read_modal_table(path).mode) == 1


def test_a_mass_in_grams_is_questioned():
    assert specimen_doubts({"mass": [{"mass_kg": 0.005}, {"mass_kg": 0.4}]}) == []
    (doubt,) = specimen_doubts({"mass": [{"mass_kg": 0.005}, {"mass_kg": 5}]})
    assert doubt.startswith("mass.mass_kg = 5 is outside 1e-05 to 2")
    assert doubt.endswith("is it in g?")


@pytest.mark.parametrize(
    ("young_gpa", "density", "asked"),
    [
        (209.0, 789.5, "is one of them another layer's"),
        (10.0, 2700.0, "in millions of psi"),
        (30.0, 7850.0, "in millions of psi"),
    ],
)
def test_a_face_that_is_no_solid_is_asked_about(young_gpa, density, asked):
    (doubt,) = specimen_doubts({"constraining": {"young_gpa": young_gpa, "density_kg_m3": density}})
    assert asked in doubt


@pytest.mark.parametrize(
    ("young_gpa", "density"),
    [(69.0, 2700.0), (205.0, 7850.0), (287.0, 1850.0), (3.0, 1200.0), (16.0, 11_340.0), (50.0, 7300.0)],
)
def test_metals_and_polymers_are_not_asked_about(young_gpa, density):
    assert specimen_doubts({"substrate": {"young_gpa": young_gpa, "density_kg_m3": density}}) == []


def test_amplitudes_beside_phasors_are_theirs_or_refused(tmp_path):
    head = "frequency_hz,velocity_re_m_s,velocity_im_m_s,velocity_m_s\n"
    path = written(tmp_path, head + "10,0.03,0.04,0.05\n20,0.03,0.04,0.1\n", "both.csv")
    with pytest.raises(BadInput, match=r"line 3: velocity_m_s = 0\.1 beside a phasor of 0\.05, expected one"):
        read_sweep(path)
    path = written(tmp_path, head + "10,0.03,0.04,0.05\n20,0.03,0.04,0.0501\n", "both.csv")
    assert read_sweep(path).columns["velocity_m_s"].size == 2
