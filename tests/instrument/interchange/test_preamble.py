"""What stands above a table: its units, and PULSE's layout."""

import pytest

from instrument.interchange.preamble import named_by_preamble, with_stated_units

NAMES = ["Freq (Hz)", "Real", "Imag"]
PULSE = [
    "Header Size:\t7",
    "Data Type:\tComplex",
    "X-Axis size:\t2",
    "X-Axis unit:\tHz",
    "AmplitudeUnit:\t(m/s)/(m/s²)",
]
ROWS = [(9, ["1", "20", "0.1", "0.2"]), (10, ["2", "21", "0.1", "0.2"])]


@pytest.mark.parametrize(
    "line", ['"Y Units","g/N"', "Y axis unit\tg/N", "Ordinate unit: g/N", "amplitude units = g/N;"]
)
def test_a_unit_above_the_table_is_that_of_names_that_are_parts_alone(line):
    names, said = with_stated_units(NAMES, ["Title", line])
    assert names == ["Frequency [Hz]", "Real [g/N]", "Imag [g/N]"]
    assert said == ["in g/N as stated above the table"]


def test_no_unit_is_taken_where_two_are_stated_or_none_is_known():
    assert with_stated_units(NAMES, ["Y unit: g/N", "Y unit: m/N"])[0][1:] == NAMES[1:]
    assert with_stated_units(NAMES, ["Y unit: V/V"])[0][1:] == NAMES[1:]


def test_names_that_say_their_unit_keep_it():
    names = ["frequency_hz", "Velocity real [mm/s]", "FRF"]
    assert with_stated_units(names, ["Y unit: g/N"]) == (names, [])


def test_an_axis_without_a_name_is_a_frequency_by_its_unit():
    assert with_stated_units(["X", "Real"], ["X axis unit\tkHz"])[0][0] == "Frequency [kHz]"
    assert with_stated_units(["X", "Real"], ["X axis unit\ts"])[0][0] == "X"


def test_the_layout_of_pulse_is_known_by_its_head():
    assert named_by_preamble(PULSE, ROWS) == [
        "",
        "Frequency [Hz]",
        "Real [(m/s)/(m/s²)]",
        "Imag [(m/s)/(m/s²)]",
    ]


@pytest.mark.parametrize(
    ("head", "rows"),
    [(PULSE[1:], ROWS), (PULSE, ROWS[:1]), (PULSE, [(9, ["1", "20", "1"])] * 2), (PULSE, [ROWS[1], ROWS[0]])],
    ids=["no head", "a row too few", "no imaginary part", "not numbered"],
)
def test_what_does_not_fit_the_head_has_no_names(head, rows):
    assert named_by_preamble(head, rows) is None
