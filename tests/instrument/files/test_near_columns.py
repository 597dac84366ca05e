"""Columns of nearly a known name."""

import pytest

from instrument.files.near_columns import near_columns, words_of_near
from instrument.files.sweep_file import read_sweep


@pytest.mark.parametrize(
    ("name", "own"),
    [
        *(("time", "time_s"), ("Time_s", "time_s"), ("time_ms", "time_s"), ("temperature", "temperature_c")),
        *(("temp_c", "temperature_c"), ("std", "velocity_std_m_s"), ("segments", "segment")),
        *(("pass", "sweep"), ("Sweep No.", "sweep"), ("pickup_no", "pickup")),
    ],
)
def test_a_column_that_is_not_read_is_named_with_the_one_that_it_is_like(name, own):
    assert near_columns(["frequency_hz", name]) == {name: own}


@pytest.mark.parametrize("name", ["time_constant_s", "sweep_rate", "temp_room_c", "note", "step", ""])
def test_a_column_that_says_something_else_is_not(name):
    assert near_columns(["frequency_hz", name]) == {}


def test_nor_is_one_beside_the_column_itself():
    assert near_columns(["time_s", "Time", "temperature_c", "temp_k"]) == {}
    assert words_of_near("a.csv", ["time_s", "Time"]) == ""


def test_a_sweep_names_them_in_one_line(tmp_path):
    (tmp_path / "a.csv").write_text("frequency_hz,velocity_m_s,time,temp_c\n20,0.1,0,21\n40,0.2,5,22\n")
    said = read_sweep(tmp_path / "a.csv").remark
    assert said.endswith(
        "not read, as columns of no known name: time (is it time_s?), temp_c (is it temperature_c?)"
    )
