"""Named arrays of a table or a MATLAB file: what their names, units and shapes make of them."""

import numpy as np
import pytest
from foreign_files import F, lms
from hypothesis import given
from hypothesis import strategies as st
from scipy.io import savemat

from instrument.errors import BadInput
from instrument.files.units import unit_of
from instrument.interchange.found import Found
from instrument.interchange.importing import import_file
from instrument.interchange.read_mat import read_mat
from instrument.interchange.read_table import read_table

V = np.array([0.1 + 0.02j, 0.2 - 0.1j, -0.05 - 0.3j, -0.1j, 0.02 + 0.01j])
OMEGA = 2 * np.pi * F


def of(table):
    found = Found()
    assert read_table("a", table, found)
    return found


def velocity(found):
    (columns,) = found.sweeps
    return columns["velocity_re_m_s"] + 1j * columns["velocity_im_m_s"]


# A sweep


@pytest.mark.parametrize(
    "table",
    [
        {"velocity_re_m_s": V.real, "velocity_im_m_s": V.imag},
        {"Velocity real [mm/s]": 1e3 * V.real, "Velocity imag [mm/s]": 1e3 * V.imag},
        {"v_magnitude_mm_s": 1e3 * np.abs(V), "v_phase": np.angle(V, deg=True)},
        {"v_mm_s": 1e3 * np.abs(V), "v_phase_rad": np.angle(V)},
        {"response (m)": V / (1j * OMEGA)},
        {"accel_re_g": (1j * OMEGA * V).real / 9.80665, "accel_im_g": (1j * OMEGA * V).imag / 9.80665},
    ],
    ids=["ours", "millimetres in brackets", "degrees", "radians", "displacement", "acceleration in g"],
)
def test_a_motion_in_any_parts_and_units_is_the_same_velocity(table):
    np.testing.assert_allclose(velocity(of({"frequency_hz": F, **table})), V, rtol=1e-6)


@pytest.mark.parametrize(
    "axis",
    [
        {"freq": F},
        {"frequency_khz": F / 1e3},
        {"f [rad/s]": OMEGA},
        {"Frequency (Hz)": F},
        {"omega [rad/s]": OMEGA},
        {"ω (1/s)": OMEGA},
        {"omega": OMEGA},
        {"Angular frequency": OMEGA},
        {"omega_rad_s": OMEGA, "f_hz": F},
    ],
)
def test_an_axis_of_frequencies_is_known_by_its_name_and_unit(axis):
    (columns,) = of({**axis, "velocity_m_s": np.abs(V)}).sweeps
    np.testing.assert_allclose(columns["frequency_hz"], F)
    np.testing.assert_allclose(columns["velocity_m_s"], np.abs(V))


def test_a_single_number_is_that_of_every_row():
    table = {"frequency_hz": F, "velocity_m_s": np.abs(V), "level_g": np.array(0.5)}
    (columns,) = of(table | {"temperature_c": np.array([21.0]), "segment": np.array(3)}).sweeps
    assert columns["level_g"].tolist() == [0.5] * 5
    assert columns["temperature_c"].tolist() == [21.0] * 5
    assert columns["segment"].tolist() == [3.0] * 5


def test_what_is_known_of_some_rows_is_kept_and_of_none_is_not():
    some = np.array([21.0, np.nan, 21.0, 21.0, 21.0])
    table = {"frequency_hz": F, "velocity_m_s": np.abs(V), "mass_kg": some, "temperature_c": some * np.nan}
    (columns,) = of(table).sweeps
    np.testing.assert_array_equal(columns["mass_kg"], some)
    assert "temperature_c" not in columns


def test_columns_of_other_shapes_and_kinds_are_said_to_be_left_out():
    table = {"frequency_hz": F, "velocity_m_s": np.abs(V), "level_g": np.ones((5, 2)), "weight": V}
    assert of(table).said[:2] == [
        "passed over: a: level_g: float64 of shape (5, 2)",
        "passed over: a: weight: complex128 of shape (5,)",
    ]


def test_complex_frequencies_are_no_axis():
    found = Found()
    assert not read_table("a", {"frequency_hz": F + 1j, "velocity_m_s": np.abs(V)}, found)


def test_a_motion_of_the_base_stands_beside_the_response_as_acceleration():
    base_m_s = 0.01 * np.exp(0.3j) * np.ones(5)
    found = of({"frequency_hz": F, "tip (m/s)": V, "base (m/s)": base_m_s, "signal_level": np.full(5, 0.5)})
    (columns,) = found.sweeps
    base = columns["base_accel_re_m_s2"] + 1j * columns["base_accel_im_m_s2"]
    np.testing.assert_allclose(base, 1j * OMEGA * base_m_s)
    assert "with base (m/s), 5 points, 15 to 30 Hz" in found.said[0]


def test_a_column_of_our_own_passes_as_it_is():
    (columns,) = of({"frequency_hz": F, "velocity_m_s": np.abs(V), "segment": np.arange(5.0)}).sweeps
    np.testing.assert_array_equal(columns["segment"], np.arange(5.0))


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"a_m_s": np.abs(V), "b_m_s": np.abs(V)}, "which is the response"),
        ({"tip_m_s": V, "base_m_s2": V, "ref_m_s2": V}, "which is the response"),
        ({"velocity_re_m_s": V.real}, "its other part is missing, expected re and im"),
    ],
)
def test_what_contradicts_itself_is_refused(table, said):
    with pytest.raises(BadInput, match=said):
        of({"frequency_hz": F, **table})


def test_an_acceleration_at_zero_cannot_be_a_velocity():
    with pytest.raises(BadInput, match="at 0 Hz cannot be integrated"):
        of({"frequency_hz": F - F[0], "a (m/s^2)": V})


def test_numbers_without_an_axis_or_a_force_are_none_of_ours():
    found = Found()
    assert not read_table("a", {"velocity_m_s": np.abs(V), "colour": F}, found)
    assert not read_table("a", {"frequency_hz": F, "colour": F}, found)
    assert (found.sweeps, found.frfs, found.hits) == ([], [], [])


@pytest.mark.parametrize(("name", "motion"), [("Accelerance", "acceleration"), ("mobility", "velocity")])
def test_a_ratio_is_known_by_its_name_and_keeps_its_coherence(name, motion):
    found = of({"frequency_hz": F, name: V, "coherence": np.linspace(0.5, 0.9, 5)})
    ((_, frf, coherence),) = found.frfs
    assert frf.motion == motion
    np.testing.assert_array_equal(frf.H, V)
    np.testing.assert_array_equal(coherence, np.linspace(0.5, 0.9, 5))


@pytest.mark.parametrize("name", ["coherence", "coherence tip"])
def test_of_two_ratios_each_has_the_coherence_of_its_name_and_one_without_is_nobodys(name):
    table = {"frequency_hz": F, "H root (g/N)": V, "H tip (g/N)": 2 * V, name: np.full(5, 0.9)}
    root, tip = of(table).frfs
    assert root[2] is None
    assert (tip[2] is None) == (name == "coherence")
    root, tip = of({**table, "Coherence root": np.full(5, 0.8)}).frfs
    assert root[2].tolist() == 5 * [0.8]


def test_a_ratio_in_g_over_newtons_is_in_si():
    ((_, frf, coherence),) = of({"frequency_hz": F, "FRF (g/N)": V}).frfs
    np.testing.assert_allclose(frf.H, unit_of("g").factor * V)
    assert coherence is None


# Records


BLOWS = np.array([[0.0, 0.0], [5.0, 6.0], [0.0, 0.0]])


@given(rate=st.floats(100.0, 1e5), hits=st.integers(1, 3))
def test_columns_of_a_matrix_are_hits_at_the_rate_that_is_said(rate, hits):
    force = np.tile([[0.0], [5.0], [0.0]], hits) * np.arange(1, hits + 1)
    found = of({"force_n": force, "acceleration_m_s2": -force, "fs": np.array([rate])})
    assert [h.sample_rate_hz for h in found.hits] == hits * [rate]
    for k, hit in enumerate(found.hits):
        np.testing.assert_array_equal(hit.force_n, force[:, k])
        np.testing.assert_array_equal(hit.responses[0].samples, -force[:, k])


def test_a_hit_that_was_not_accepted_is_left_out_and_said():
    table = {"force_n": BLOWS, "a_m_s2": BLOWS, "time_s": np.arange(3) / 500, "accepted": np.array([0, 1])}
    found = of(table)
    (hit,) = found.hits
    np.testing.assert_array_equal(hit.force_n, BLOWS[:, 1])
    assert hit.sample_rate_hz == pytest.approx(500)
    assert "passed over: a hit 1: not accepted" in found.said


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"force_n": BLOWS, "a_m_s2": BLOWS}, "no sample rate"),
        ({"force_n": BLOWS, "a_m_s2": BLOWS, "t": np.array([0.0, 0.1, 0.5])}, "not evenly spaced"),
        ({"force_n": BLOWS, "a_m_s2": BLOWS[:2], "fs": np.ones(1)}, "no response of 3 samples"),
        ({"force_n": BLOWS, "tip_kn": BLOWS, "fs": np.ones(1)}, "which is the force"),
        ({"force_n": BLOWS, "a_m_s2": 1j * BLOWS, "fs": np.ones(1)}, "complex samples in time"),
    ],
)
def test_records_that_cannot_be_read_are_refused(table, said):
    with pytest.raises(BadInput, match=said):
        of(table)


# MATLAB


def mat(tmp_path, **variables):
    savemat(tmp_path / "a.mat", variables, oned_as="column")
    return read_mat(tmp_path / "a.mat")


def test_arrays_of_one_struct_belong_together_however_deep(tmp_path):
    one = {"frequency_hz": F, "velocity_m_s": V}
    found = mat(tmp_path, day={"first": one, "second": {"frequency_hz": F, "velocity_m_s": 2 * V}})
    assert len(found.sweeps) == 2
    np.testing.assert_allclose(found.sweeps[1]["velocity_re_m_s"], 2 * V.real)


def test_what_this_program_says_about_its_own_arrays_is_no_data(tmp_path):
    found = mat(
        tmp_path, units={"colour": np.arange(3.0)}, about={"size": np.arange(3.0)}, taste=np.arange(3.0)
    )
    assert found.said == ["passed over: a.mat: taste"]


def test_testlab_columns_over_a_force_are_frfs_of_their_own(tmp_path):
    found = mat(tmp_path, H=lms(np.column_stack([V, 2 * V]), "g/N"))
    (_, first, _), (_, second, _) = found.frfs
    np.testing.assert_allclose(first.frequency_hz, 10 + 0.5 * np.arange(5))
    np.testing.assert_allclose(second.H, 2 * unit_of("g").factor * V)


def test_testlab_values_of_an_uneven_axis_are_taken_as_they_are(tmp_path):
    function = lms(V, "(m/s)/N")
    function["x_values"]["values"] = F
    ((_, frf, _),) = mat(tmp_path, H=function).frfs
    np.testing.assert_allclose(frf.frequency_hz, F)


@pytest.mark.parametrize(("unit", "factor"), [("kHz", 1e3), ("rad/s", 1 / (2 * np.pi)), ("Hz", 1.0)])
def test_testlab_lines_are_in_hertz_whatever_their_label(tmp_path, unit, factor):
    found = mat(tmp_path, H=lms(V, "(m/s)/N", x_label=unit))
    np.testing.assert_allclose(found.frfs[0][1].frequency_hz, factor * (10 + 0.5 * np.arange(5)))


def test_testlab_orders_are_no_frequencies(tmp_path):
    with pytest.raises(BadInput, match="H: abscissa in 'rpm', expected Hz"):
        mat(tmp_path, H=lms(V, "(m/s)/N", x_label="rpm"))


def recorded(values, label, step=1e-3):
    return lms(values, label, x_label="s", start=0.0, step=step)


@pytest.mark.parametrize(
    ("functions", "said"),
    [
        ({"F": recorded(BLOWS[:, 0], "N"), "G": recorded(BLOWS[:, 0], "N")}, "2 forces"),
        (
            {"F": recorded(BLOWS[:, 0], "N"), "a": recorded(BLOWS[:2, 0], "g")},
            "no response of its",
        ),
        ({"F": recorded(BLOWS[:, 0], "furlong")}, "ordinate in 'furlong'"),
        ({"F": recorded(BLOWS[:, 0], "N", step=0.0)}, "a step of 0, expected"),
        ({"F": recorded(BLOWS[:, 0], "N") | {"x_values": 5.0}}, "F: x_values is 5.*, expected a struct"),
        ({"F": recorded(BLOWS[:, 0], "N") | {"y_values": {"values": 5.0}}}, r"values of shape \(\)"),
    ],
)
def test_testlab_functions_that_cannot_be_read_are_refused(tmp_path, functions, said):
    with pytest.raises(BadInput, match=said):
        mat(tmp_path, **functions)


def test_testlab_spectra_and_records_without_a_force_are_passed_over(tmp_path):
    found = mat(tmp_path, S=lms(np.abs(V), "g"), a=recorded(BLOWS[:, 0], "g"))
    assert found.said == [
        "passed over: S: a spectrum in g, expected one signal over another",
        "passed over: a: no force among them",
    ]


def test_a_matlab_file_of_names_that_say_nothing_hears_which_would(tmp_path):
    savemat(tmp_path / "a.mat", {"x": np.arange(3.0), "y": np.arange(3.0)})
    with pytest.raises(BadInput, match=r"passed over: a\.mat: x, y; expected .* frf_mm_s_per_g"):
        import_file(tmp_path / "a.mat", tmp_path / "out.csv")
