"""Temperatures by the names that other programs give them."""

import numpy as np
import pytest

from instrument.interchange.celsius import is_temperature, with_celsius
from instrument.interchange.found import Found
from instrument.interchange.read_csv import read_csv
from instrument.interchange.read_table import read_table

F = np.array([20.0, 40.0, 60.0])
V = {"Velocity [m/s]": np.array([0.1, 0.3, 0.2])}


def of(table):
    found = Found()
    assert read_table("a", {"frequency_hz": F, **V, **table}, found)
    return found


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("Temperature [K]", 293.15),
        ("Temp (°F)", 68.0),
        ("Specimen temperature [C]", 20.0),
        ("Température [°C]", 20.0),
        ("temperature_k", 293.15),
        ("Temp deg F", 68.0),
        ("temp_c", 20.0),
    ],
)
def test_a_temperature_is_read_in_celsius(name, value):
    found = of({name: np.full(3, value)})
    np.testing.assert_allclose(found.sweeps[0]["temperature_c"], 20.0)
    assert any(line.startswith(f"a: {name} as temperature_c") for line in found.said)


@pytest.mark.parametrize("name", ["Temperature", "Temp [V]", "temperature_sensor_2"])
def test_a_temperature_in_no_known_unit_is_passed_over_and_said(name):
    found = of({name: np.full(3, 293.15)})
    assert "temperature_c" not in found.sweeps[0]
    assert f"passed over: a: {name}: in C, K or F? expected it in its name" in found.said


def test_of_two_temperatures_none_is_taken():
    found = of({"Temp air [C]": np.full(3, 21.0), "Temp plate [C]": np.full(3, 20.0)})
    assert "temperature_c" not in found.sweeps[0]
    assert any("which is the specimen's?" in line for line in found.said)


def test_a_column_of_ours_stands_before_another_programs():
    found = of({"temperature_c": np.full(3, 20.0), "Temperature [K]": np.full(3, 300.0)})
    np.testing.assert_array_equal(found.sweeps[0]["temperature_c"], 20.0)
    assert any("temperature_c stands beside it" in line for line in found.said)


def test_a_row_whose_temperature_is_not_known_stays_so(tmp_path):
    rows = ["Frequency [Hz],Velocity [m/s],Temp [K]", "20,0.1,293.15", "40,0.3,", "60,0.2,295.15"]
    (tmp_path / "a.csv").write_text("\n".join(rows))
    np.testing.assert_allclose(read_csv(tmp_path / "a.csv").sweeps[0]["temperature_c"], [20, np.nan, 22])


def test_what_says_nothing_of_warmth_is_left_alone():
    table = {"Template": np.ones(3), "x": np.ones(3)}
    assert with_celsius("a", table, Found()) is table
    assert not is_temperature("Attempt")
