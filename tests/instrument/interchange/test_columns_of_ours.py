"""Columns of a sweep that are ours by another name: times, passes, regions, spots and weights."""

import numpy as np
import pytest

from instrument.interchange.columns_of_ours import ours, with_columns_of_ours
from instrument.interchange.found import Found
from instrument.interchange.read_csv import read_csv
from instrument.interchange.read_table import read_table

F = np.array([20.0, 40.0, 60.0])
V = {"Velocity [m/s]": np.array([0.1, 0.3, 0.2])}


def of(table):
    found = Found()
    assert read_table("a", {"Frequency [Hz]": F, **V, **table}, found)
    return found


@pytest.mark.parametrize(
    ("name", "seconds"),
    [
        *(("Time [s]", 1.0), ("Zeit [s]", 1.0), ("Temps (s)", 1.0), ("Time_s", 1.0), ("Zeit in s", 1.0)),
        *(
            ("time_ms", 1e-3),
            ("Time [min]", 60.0),
            ("Zeit / min", 60.0),
            ("Time (h)", 3600.0),
            ("t [s]", 1.0),
        ),
    ],
)
def test_times_come_along_in_seconds(name, seconds):
    found = of({name: np.array([0.0, 1.0, 3.0])})
    np.testing.assert_allclose(found.sweeps[0]["time_s"], seconds * np.array([0.0, 1.0, 3.0]))
    assert found.said[0] == f"a: {name} as time_s"


@pytest.mark.parametrize(
    ("name", "own"),
    [
        *(
            ("Segment", "segment"),
            ("Abschnitt Nr.", "segment"),
            ("Sweep No", "sweep"),
            ("Durchlauf", "sweep"),
        ),
        *(("Pickup", "pickup"), ("Weight [-]", "weight"), ("Gewichtung", "weight")),
    ],
)
def test_what_is_counted_comes_along_by_its_word(name, own):
    found = of({name: np.array([1.0, 2.0, 3.0])})
    np.testing.assert_array_equal(found.sweeps[0][own], [1.0, 2.0, 3.0])
    assert found.said[0] == f"a: {name} as {own}"


@pytest.mark.parametrize("name", ["Time stamp", "Time std [s]", "t", "Segment length", "Sweep [Hz/min]"])
def test_what_is_only_like_one_of_ours_is_passed_over_and_said(name):
    assert not ours(name)
    assert of({name: F}).said[-1] == f"passed over: a: {name}"


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"Time": F}, "Time: in s, ms, min or h? expected it in its name"),
        ({"Time [s]": np.array([0.0, np.nan, 1.0])}, "Time [s]: not known of every row"),
        ({"Time [s]": F, "Elapsed": F, "Zeit [min]": F}, "Time [s], Zeit [min]: which of them? expected one"),
        ({"time_s": F, "Time [min]": F}, "Time [min]: time_s stands beside it"),
    ],
)
def test_what_may_be_one_of_ours_and_is_not_taken_is_said_with_its_reason(table, said):
    found = Found()
    with_columns_of_ours("a", table, found)
    assert found.said == [f"passed over: a: {said}"]


def test_they_stand_beside_ratios_of_the_base_too():
    ratio = {"FRF real [(m/s)/g]": np.array([0.1, 0.3, 0.2]), "FRF imag [(m/s)/g]": np.zeros(3)}
    found = Found()
    table = {"Frequency [Hz]": np.array([0.0, 20.0, 40.0]), **ratio, "Time [s]": np.arange(3.0)}
    assert read_table("a", table | {"velocity_std_m_s": np.ones(3)}, found)
    (columns,) = found.sweeps
    np.testing.assert_array_equal(columns["time_s"], [1.0, 2.0])
    assert "passed over: a: velocity_std_m_s" in found.said


def test_beside_a_response_over_a_force_they_are_said_to_be_passed_over(tmp_path):
    rows = ["Frequency [Hz],FRF real [m/s/N],FRF imag [m/s/N],Segment", "20,0.1,0.2,1", "40,0.3,0.1,2"]
    (tmp_path / "a.csv").write_text("\n".join(rows))
    assert "passed over: a.csv: Segment" in read_csv(tmp_path / "a.csv").said
