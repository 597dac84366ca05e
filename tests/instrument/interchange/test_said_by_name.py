"""What names of columns say, and what is asked where they do not say enough."""

import numpy as np
import pytest
from foreign_files import F
from hypothesis import given
from hypothesis import strategies as st

from instrument.errors import BadInput
from instrument.interchange.found import Found
from instrument.interchange.read_csv import read_csv
from instrument.interchange.read_table import read_table
from instrument.interchange.said_by_name import axis_of, radians, refuse_contradiction, refuse_unknown
from instrument.interchange.unit_in_name import amplitude_factor, unit_in

V = np.array([0.1 + 0.02j, 0.2 - 0.1j, -0.05 - 0.3j, -0.1j, 0.02 + 0.01j])
PARTS = {"Velocity real [m/s]": V.real, "Velocity imag [m/s]": V.imag}
HERTZ = {"Hz": 1.0, "kHz": 1e3, "rad/s": 0.5, "": 1.0}


def of(table):
    found = Found()
    assert read_table("a", {"frequency_hz": F, **table}, found)
    return found


@given(
    size=st.sampled_from(["rms", "RMS", "eff"]),
    places=st.sampled_from(["v {} [m/s]", "v [m/s {}]", "v_{}_m_s"]),
)
def test_an_rms_value_is_a_sines_amplitude_over_root_two(size, places):
    assert amplitude_factor(places.format(size)) == pytest.approx(np.sqrt(2))


@pytest.mark.parametrize("size", ["pp", "p-p", "pk-pk", "peak to peak", "Peak-to-peak"])
def test_a_value_from_peak_to_peak_is_two_amplitudes(size):
    assert amplitude_factor(f"Velocity {size} [m/s]") == 0.5
    assert amplitude_factor("Velocity peak [m/s]") == amplitude_factor("Upper velocity [m/s]") == 1.0
    name = f"Velocity amplitude [mm/s {size}]"
    assert (amplitude_factor(name), unit_in(name).factor) == (0.5, pytest.approx(1e-3))


def test_what_is_made_of_an_rms_value_is_said():
    found = of({"Velocity [m/s rms]": np.abs(V)})
    np.testing.assert_allclose(found.sweeps[0]["velocity_m_s"], np.sqrt(2) * np.abs(V))
    assert "Velocity [m/s rms] times 1.414 as velocity amplitudes" in found.said[0]


@pytest.mark.parametrize(
    ("column", "said"),
    [
        ({"Base accel [ell/s^2]": F}, "in 'ell/s\\^2', expected one of"),
        ({"Base real [V]": F, "Base imag [V]": F}, "Base real .V.: in 'V', expected one of"),
        ({"Reference [counts]": F}, "in 'counts', expected one of"),
        ({"Base accel real": F, "Base accel imag": F}, "Base accel real: no unit, expected one in its name"),
        ({"Force2 [V]": F}, "Force2 .V.: in 'V', expected one of"),
        ({"Base accel real [g]": F, "Base accel imag [m/s^2]": F}, "expected both in one unit"),
    ],
)
def test_a_base_or_force_in_no_known_unit_is_not_left_out_in_silence(column, said):
    with pytest.raises(BadInput, match=said):
        of(PARTS | column)


def test_what_decides_nothing_needs_no_unit_and_is_said_to_be_left_out():
    refuse_unknown("a", "Velocity range", None)
    refuse_unknown("a", "Drive [V]", None)
    found = of(PARTS | {"Drive [V]": F, "Coherence": F})
    assert found.said[1:] == ["passed over: a: Drive [V]"]


@pytest.mark.parametrize("name", ["frequency_rpm", "Frequency [1/min]", "freq_vector"])
def test_frequencies_in_another_unit_are_refused(name):
    with pytest.raises(BadInput, match=r"in which unit\? expected one of Hz, kHz, rad/s"):
        axis_of("a", [name], ("frequency", "freq"), HERTZ)


def test_an_axis_is_the_plainest_of_its_kind_in_its_unit():
    assert axis_of("a", ["frequency_std_hz", "frequency_hz"], ("frequency",), HERTZ) == [
        ("frequency_hz", 1.0)
    ]
    assert axis_of("a", ["frequency_rad_s"], ("frequency",), HERTZ) == [("frequency_rad_s", 0.5)]
    assert axis_of("a", ["frequency_rpm"], ("frequency",), HERTZ, needed=False) == []


def test_phases_are_in_the_unit_that_is_said_and_asked_about_where_none_is():
    np.testing.assert_allclose(radians("a", "Phase [rad]", F), F)
    np.testing.assert_allclose(radians("a", "Phase", 10 * F), np.deg2rad(10 * F))
    with pytest.raises(BadInput, match="are these rad"):
        radians("a", "Phase", np.angle(V))
    with pytest.raises(BadInput, match="in 'mrad', expected deg or rad"):
        radians("a", "Phase [mrad]", F)


def test_an_amplitude_of_a_ratio_is_no_ratio():
    with pytest.raises(BadInput, match="no phase, expected real and imaginary part"):
        of({"FRF magnitude [(m/s)/g]": np.abs(V)})


def test_two_ratios_of_a_table_are_two_spots():
    found = of({"H tip [(m/s)/g]": V, "H root [(m/s)/g]": V})
    assert [s["pickup"][0] for s in found.sweeps] == [0, 1]
    assert found.spots == ["H tip [(m/s)/g]", "H root [(m/s)/g]"]


def test_a_force_beside_a_velocity_is_what_drives_it():
    found = of(PARTS | {"Force [N]": V})
    np.testing.assert_allclose(found.sweeps[0]["force_im_n"], V.imag)
    with pytest.raises(BadInput, match="which is the response"):
        of(PARTS | {"Force [N]": V, "Base [g]": V})


def test_a_base_without_phase_beside_phasors_is_said():
    assert "with Base [g] (no phase: taken as 0)" in of(PARTS | {"Base [g]": F}).said[0]


def test_a_rate_and_times_that_contradict_are_refused():
    table = {
        "time_s": np.arange(9) / 500,
        "force_n": F[[0] * 9],
        "a_m_s2": F[[0] * 9],
        "fs": np.array([480.0]),
    }
    with pytest.raises(BadInput, match="sample rates contradict: 480, 500 Hz"):
        read_table("a", table, Found())


def test_a_ratio_in_the_unit_of_one_signal_is_no_motion():
    with pytest.raises(BadInput, match="a ratio in one unit, expected one over another"):
        of({"FRF real [m/s]": V.real, "FRF imag [m/s]": V.imag})


@pytest.mark.parametrize(
    ("frequency_hz", "velocity", "said"),
    [
        (F, np.where(F[2] == F, np.nan, V), "a: row 3 of 5: velocity_m_s = nan, expected a finite number"),
        (F - F[0], V, "a: row 1 of 5: frequency in Hz = 0, expected more than 0"),
        (np.where(F[2] == F, np.nan, F), V, "a: row 3 of 5: frequency in Hz = nan, expected a finite number"),
    ],
)
def test_a_row_that_is_none_is_refused_by_its_place(frequency_hz, velocity, said):
    with pytest.raises(BadInput, match=said):
        read_table("a", {"frequency_hz": frequency_hz, "velocity_m_s": velocity}, Found())


def test_a_matrix_beside_frequencies_is_said_to_be_left_out():
    found = Found()
    read_table("a", {"frequency_hz": F, "velocity_m_s": np.column_stack([V, V])}, found)
    assert found.said == ["passed over: a: velocity_m_s: (5, 2) beside 5 frequencies"]


# In a file


def csv(tmp_path, text):
    (tmp_path / "a.csv").write_text(text)
    return read_csv(tmp_path / "a.csv")


def test_a_column_that_lacks_its_first_number_is_refused_by_its_place(tmp_path):
    with pytest.raises(BadInput, match="line 2: '', expected a number"):
        csv(tmp_path, "frequency_hz,velocity_m_s,base_accel_m_s2\n1,2,\n2,3,9.81\n")


def test_a_column_of_words_is_said_to_be_left_out(tmp_path):
    found = csv(tmp_path, "frequency_hz,velocity_m_s,remark\n1,2,good\n2,3,4\n")
    assert found.said[0] == "passed over: a.csv: remark: no numbers"


def test_a_single_row_is_no_sweep(tmp_path):
    with pytest.raises(BadInput, match="and two rows or more"):
        csv(tmp_path, "frequency_hz,velocity_m_s\n1,2\n")


@pytest.mark.parametrize("row", ["1,020;0,5;0.1", "1.020,5;0,5;0,1"])
def test_thousands_that_are_parted_are_no_decimals(tmp_path, row):
    with pytest.raises(BadInput, match=r"line 3: .* expected one decimal mark"):
        csv(tmp_path, f"Frequency [Hz];Velocity real [m/s];Velocity imag [m/s]\n10;1;1\n{row}\n")


def test_a_ratio_that_is_called_by_its_word_alone_is_said_to_be_in_si():
    told = of({"Inertance real": F, "Inertance imag": F}).said
    assert "a: Inertance real: no unit, taken in SI's" in told
    assert not any("taken in" in line for line in of({"mobility_re_mm_s_n": F, "mobility_im_mm_s_n": F}).said)
    with pytest.raises(BadInput, match="mobility_kn: no unit, expected one in its name"):
        of({"mobility_kn": F})


def test_a_column_is_no_axis_for_its_first_letter():
    assert of(PARTS | {"fan speed": F, "tip": F, "f [Hz]": F}).said[1:] == ["passed over: a: fan speed, tip"]


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("Acceleration [m/s]", "velocity"),
        ("Velocity [g]", "acceleration"),
        ("Displacement 2 [mm/s]", "velocity"),
        ("Force [g]", "acceleration"),
        ("Mobility real [g/N]", "acceleration over force"),
    ],
)
def test_a_name_and_a_unit_of_different_quantities_are_asked_about(name, unit):
    with pytest.raises(BadInput, match=f"its unit is of {unit}: which is it"):
        refuse_contradiction("a", name, unit_in(name))


@pytest.mark.parametrize(
    "name", ["Velocity from acceleration [m/s]", "mobility_re", "Accel FRF [g/N]", "Tip [mm/s]"]
)
def test_a_name_that_does_not_contradict_its_unit_is_taken(name):
    refuse_contradiction("a", name, unit_in(name))


def test_the_base_of_an_rms_value_says_what_it_is_itself():
    rms = {"Velocity [m/s rms]": np.abs(V)}
    with pytest.raises(BadInput, match=r"Base .g.: rms, peak or peak to peak beside Velocity .m/s rms.\?"):
        of(rms | {"Base [g]": F})
    with pytest.raises(BadInput, match=r"Velocity real .m/s.: rms, peak or peak to peak beside Base rms .g."):
        of(PARTS | {"Base rms [g]": F})
    assert "with Base [g pk]" in of(rms | {"Base [g pk]": F}).said[0]


@pytest.mark.parametrize("size", ["Velocity [m/s]", "Tip magnitude [m/s]"])
def test_a_phase_alone_is_that_of_the_only_response(size):
    degrees = {"Phase [deg]": np.angle(V, deg=True)}
    for beside in ({}, {"Base real [g]": F, "Base imag [g]": 0 * F}):
        (columns,) = of({size: np.abs(V), **degrees, **beside}).sweeps
        np.testing.assert_allclose(columns["velocity_re_m_s"] + 1j * columns["velocity_im_m_s"], V)
    ((_, frf, _),) = of({"FRF [(m/s)/N]": np.abs(V), **degrees}).frfs
    np.testing.assert_allclose(frf.H, V)


def test_a_phase_of_nobody_knows_what_is_said_to_be_left_out():
    found = of({**PARTS, "Phase [deg]": F})
    assert found.said[1:] == ["passed over: a: Phase [deg]"]


def test_phases_that_may_be_unwrapped_rad_are_asked_about():
    with pytest.raises(BadInput, match="are these rad"):
        radians("a", "Phase", np.array([-1.0, -4.0, -8.0, -12.0]))


def test_a_size_below_zero_beside_a_phase_is_asked_about():
    with pytest.raises(BadInput, match=r"FRF magnitude .g/N.: -3 as a size beside a phase: in dB"):
        of({"FRF magnitude [g/N]": F - 18.0, "FRF phase [deg]": F})


@pytest.mark.parametrize("word", ["PSD", "ASD", "power", "spectral density", "Autopower"])
def test_a_power_is_no_amplitude(word):
    with pytest.raises(BadInput, match="is a power or a density"):
        of({f"Velocity {word} [m/s]": np.abs(V)})


def test_radians_of_many_turns_are_asked_about_unless_they_are_unwrapped():
    size = {"Velocity magnitude [m/s]": np.abs(V)}
    with pytest.raises(BadInput, match="are these degrees"):
        of({**size, "Velocity phase [rad]": np.degrees(np.angle(V))})
    turned = np.angle(V) - 20 * np.pi
    found = of({**size, "Velocity phase unwrapped [rad]": turned})
    np.testing.assert_allclose(found.sweeps[0]["velocity_re_m_s"], V.real, atol=1e-12)


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"Speed [m/s]": V, "speed (mm/s)": V}, "which of them"),
        (PARTS | {"Velocity re (mm/s)": F}, "which of them"),
        ({"H base/plate [g/(mm/s)]": V}, "the response over the base"),
        ({"Phase [grad]": F, "Mobility [(m/s)/N]": F}, "degrees or gradians"),
        ({"Velocity of input real [mm/s]": F, "Velocity of input imag [mm/s]": F}, "of the base by name"),
        (
            {"Velocity relative to clamp [mm/s]": F, "Table acceleration [g]": F},
            "which is the response",
        ),
        ({"Input 1 [mm/s]": F, "Input 2 [g]": F}, "which is the response"),
    ],
)
def test_what_may_be_either_is_asked_about(table, said):
    with pytest.raises(BadInput, match=said):
        of(table)


def test_two_axes_that_differ_are_asked_about():
    table = {"Frequency setpoint [Hz]": F, "Frequency measured [Hz]": 1.01 * F}
    with pytest.raises(BadInput, match="which of them"):
        read_table("a", table | PARTS, Found())
    assert read_table("a", table | {"Frequency measured [Hz]": F} | PARTS, Found())


def test_what_is_told_from_the_clamp_is_no_motion_of_it():
    found = of({"Velocity relative to clamp [mm/s]": F, "Base accel [g]": np.ones(len(F))})
    np.testing.assert_allclose(found.sweeps[0]["velocity_m_s"], 1e-3 * F)


def test_columns_of_a_matrix_of_ratios_are_spots():
    found = of({"H [(m/s)/g]": np.column_stack([V, 2 * V])})
    assert [len(s["frequency_hz"]) for s in found.sweeps] == [len(F), len(F)]
    assert found.spots == ["H [(m/s)/g] 1", "H [(m/s)/g] 2"]
