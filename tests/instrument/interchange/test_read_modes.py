"""Tables of modes as other laboratories write them, to the columns of ours."""

import numpy as np
import pytest
from scipy.io import savemat

from instrument.errors import BadInput
from instrument.files.modal_table import read_modal_table, read_modal_tables
from instrument.interchange.found import Found
from instrument.interchange.importing import import_file
from instrument.interchange.read_modes import read_modes


def imported(tmp_path, text, ending=".csv"):
    path = tmp_path / f"theirs{ending}"
    path.write_text(text, encoding="utf-8")
    return import_file(path, tmp_path / "ours.csv")


def table_of(tmp_path, text):
    imported(tmp_path, text)
    return read_modal_table(tmp_path / "ours.csv")


@pytest.mark.parametrize(
    ("column", "values"),
    [
        ("Loss factor", (0.032, 0.05)),
        ("eta [%]", (3.2, 5.0)),
        ("tan δ", (0.032, 0.05)),
        ("Damping ratio", (0.016, 0.025)),
        ("Zeta [% critical]", (1.6, 2.5)),
        ("Q", (31.25, 20.0)),
        ("Half-power bandwidth [Hz]", (4.16, 18.0)),
        ("Δf 3 dB [kHz]", (0.00416, 0.018)),
        ("Log decrement", (0.032 * np.pi, 0.05 * np.pi)),
        ("Loss factor %", (3.2, 5.0)),
        ("% of critical", (1.6, 2.5)),
    ],
)
def test_every_word_for_a_loss_comes_to_the_same(tmp_path, column, values):
    rows = "\n".join(f"{k},{f},{x}" for k, f, x in zip((2, 3), (130, 360), values, strict=True))
    read = table_of(tmp_path, f"Mode,Frequency [Hz],{column}\n{rows}\n")
    np.testing.assert_array_equal(read.frequency_hz, [130, 360])
    np.testing.assert_allclose(read.loss_factor, [0.032, 0.05])
    assert read.read == ("half-power" if "Half" in column or "3 dB" in column else None)


@pytest.mark.parametrize(
    "name", ["omega [rad/s]", "ω_n", "Angular frequency (rad/s)", "f_n [Hz],omega [rad/s]"]
)
def test_circular_frequencies_are_taken_where_there_are_no_others(tmp_path, name):
    f = np.array([130.0, 360.0])
    both = "," in name
    rows = "\n".join(
        f"{k},{f'{x},' if both else ''}{2 * np.pi * x},0.03" for k, x in zip((2, 3), f, strict=True)
    )
    np.testing.assert_allclose(table_of(tmp_path, f"Mode,{name},eta\n{rows}\n").frequency_hz, f)


def test_a_sheet_with_specimens_decimal_commas_and_degrees_fahrenheit(tmp_path):
    text = (
        "Specimen;Mode No.;Resonance frequency [Hz];Half-power bandwidth [Hz];Loss factor;Temp [F]\n"
        "A1;2;130,2;4,7;0,036;72\nA1;3;360,2;14,7;0,0408;72\n"
    )
    read = table_of(tmp_path, text)
    np.testing.assert_allclose(read.temperature_c, 22.2222, rtol=1e-4)
    np.testing.assert_allclose(read.loss_factor, [0.036, 0.0408])
    assert read.read == "half-power"


def test_standard_deviations_and_temperatures_come_along(tmp_path):
    imported(
        tmp_path,
        "n,f_n [kHz],σ_f [Hz],eta,eta std,Temp [K]\n2,.13,.1,.1,.01,293.15\n2,.12,.1,.2,.01,303.15\n",
    )
    cold, warm = read_modal_tables(tmp_path / "ours.csv")
    assert (cold.frequency_hz, warm.frequency_hz) == ([130], [120])
    assert (cold.frequency_std_hz, cold.loss_factor_std) == ([0.1], [0.01])
    assert warm.temperature_c == pytest.approx([30])


@pytest.mark.parametrize(
    ("loss", "spread", "value"),
    [
        ("zeta [%]", "zeta std [%]", 0.5),
        ("zeta [%]", "zeta sd [%]", 0.5),
        ("Damping ratio", "Damping ratio std", 0.005),
        ("ζ", "s(ζ)", 0.005),
        ("zeta", "s(zeta)", 0.005),
        ("zeta [%]", "σ(zeta) [%]", 0.5),
        ("Dämpfungsgrad [%]", "Standardabweichung Dämpfungsgrad [%]", 0.5),
        ("Loss factor [%]", "Loss factor std [%]", 1.0),
        ("eta", "s(eta)", 0.01),
    ],
)
def test_a_standard_deviation_becomes_the_loss_factors_as_the_value_does(tmp_path, loss, spread, value):
    read = table_of(
        tmp_path, f"Mode,f [Hz],s(f) [Hz],{loss},{spread}\n2,130,.1,1,{value}\n3,360,.2,1,{value}\n"
    )
    np.testing.assert_allclose(read.loss_factor_std, 0.01)
    np.testing.assert_array_equal(read.frequency_std_hz, [0.1, 0.2])


def test_those_of_circular_frequencies_are_taken_over_2_pi(tmp_path):
    read = table_of(tmp_path, "Mode,omega,omega std,eta\n2,800,6.2831853,.1\n3,900,6.2831853,.1\n")
    np.testing.assert_allclose(read.frequency_std_hz, 1.0)


@pytest.mark.parametrize("read", ["poles", "half-power", "model", None])
def test_how_modes_were_read_comes_along(tmp_path, read):
    said = f"# read: {read}\n" if read else ""
    table = table_of(tmp_path, f"{said}Mode,Frequency [Hz],eta\n2,130,.1\n3,360,.2\n")
    assert table.read == read


def test_arrays_of_a_matlab_file(tmp_path):
    savemat(tmp_path / "a.mat", {"mode": [1, 2], "f_n_hz": [20.0, 130.0], "eta": [0.1, 0.2]})
    import_file(tmp_path / "a.mat", tmp_path / "ours.csv")
    np.testing.assert_array_equal(read_modal_table(tmp_path / "ours.csv").loss_factor, [0.1, 0.2])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Mode,Frequency [Hz],Damping [%]\n2,130,1\n3,360,2\n", "the loss factor, or the ratio to critical"),
        (
            "Mode,Frequency [Hz],zeta,Q\n2,130,.016,31\n3,360,.02,10\n",
            r"row 2: loss factor 0\.04 by zeta, 0\.1",
        ),
        ("Mode,Frequency [Hz],10 dB width [Hz]\n2,130,1\n3,360,2\n", "the width at half power"),
        ("Mode,Frequency [Hz],Half width [Hz]\n2,130,1\n3,360,2\n", "half of a width"),
        ("Mode,Frequency [Hz],Half-width at half power\n2,130,1\n3,360,2\n", "half of a width"),
        ("Mode,Frequency [Hz],eta x 1000\n2,130,1\n3,360,2\n", "times a number"),
        ("Mode,f [Hz],eta,f uncertainty (k=2)\n2,130,1,1\n3,360,2,1\n", "one standard deviation"),
        ("Mode,Frequency [rpm],eta\n2,130,1\n3,360,2\n", "in 'rpm', expected hz, khz, rad/s"),
        ("Mode,Frequency [Hz],eta,eta std [%]\n2,130,1,1\n3,360,2,1\n", "eta std .* in '%', expected"),
        (
            "Mode,Frequency [Hz],zeta,zeta std [%]\n2,130,.1,1\n3,360,.2,1\n",
            "in '%', expected that of its value",
        ),
        (
            "Mode,Frequency [Hz],zeta [%],s(zeta)\n2,130,1,.1\n3,360,2,.1\n",
            "no unit, expected that of its value",
        ),
        ("Mode,Frequency [Hz],Q,Q std\n2,130,10,1\n3,360,20,1\n", "Q std: of what"),
        ("Mode,Frequency [Hz],eta,std\n2,130,1,1\n3,360,2,1\n", "of what"),
        ("Mode,f [Hz],fn [Hz],eta\n2,130,1,1\n3,360,2,1\n", "which is the mode's frequency"),
        ("Mode,f [Hz],eta\n2,130,.1\n2,360,.2\n", "mode 2 stands twice"),
        ("Mode,f [Hz],eta\n2,130,.1\n3,0,.2\n", "expected more than 0"),
        ("Mode,f [Hz],eta\n2,130,.1\n3,360,0\n", "down to 0, expected more than 0"),
        ("f [Hz],eta\n130,.1\n360,.2\n", "mode, frequency and loss factor"),
    ],
)
def test_what_does_not_say_enough_is_asked_about(tmp_path, text, said):
    with pytest.raises(BadInput, match=said):
        imported(tmp_path, text)
    assert not (tmp_path / "ours.csv").exists()


def test_a_loss_beside_a_velocity_is_no_table_of_modes(tmp_path):
    imported(tmp_path, "Frequency [Hz],Velocity [mm/s],Q\n20,1,2\n21,1,2\n")
    assert "velocity_m_s" in (tmp_path / "ours.csv").read_text()


def test_what_is_no_table_of_modes_is_left_alone():
    found = Found()
    f = np.array([20.0, 21.0])
    assert not read_modes("a", {"frequency_hz": f, "velocity_m_s": f}, found)
    assert not read_modes("a", {"frequency_hz": f, "Velocity [mm/s]": f, "Q": f}, found)
    assert found.said == []
    assert not read_modes("a", {"frequency_hz": f, "eta": f}, found)
    assert found.said == ["a: eta: of which mode? expected a column of their numbers"]
    assert found.modes == []


def test_a_sweep_with_numbers_and_a_quality_of_its_rows_is_none():
    f = np.linspace(20.0, 30.0, 5)
    table = {"Order": np.arange(5.0), "Frequency [Hz]": f, "Velocity re [mm/s]": f, "Velocity im [mm/s]": f}
    found = Found()
    assert not read_modes("a", table | {"Q": f}, found)
    assert found.modes == []
