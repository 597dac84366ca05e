"""Numbers with as many digits as their uncertainty leaves."""

import math

import pytest

from instrument.results.numbers import error_beside, format_number, signed, to_error, with_error


@pytest.mark.parametrize(
    ("value", "error", "scale", "text"),
    [
        (0.27123, 0.0131, 1.0, "0.271 ± 0.013"),
        (270003.3, 13.33, 1.0, "270003 ± 13"),
        (4.0959e6, 5.03e3, 1.0, "(4.0959 ± 0.0050)e6"),
        (1.2119673e-4, 2.32e-7, 1.0, "(1.2120 ± 0.0023)e-4"),
        (1.10015e-3, 1.1e-7, 1e6, "1100.15 ± 0.11"),
        (123456.0, 2345.0, 1.0, "123500 ± 2300"),
        (98812.0, 113996.0, 1.0, "100000 ± 110000"),
        (0.3514962, 0.02, 1.0, "0.351 ± 0.020"),
        (0.5, 0.0996, 1.0, "0.50 ± 0.10"),
        (1e-6, 0.02, 1.0, "0.000 ± 0.020"),
        (0.0, 2e-7, 1.0, "(0.0 ± 2.0)e-7"),
        (1.2e6, 3e7, 1.0, "(0.1 ± 3.0)e7"),
        (0.9, math.nan, 1.0, "0.9"),
        (0.9, None, 1.0, "0.9"),
        (math.nan, 0.1, 1.0, "-"),
        (None, 0.1, 1.0, "-"),
    ],
)
def test_two_digits_of_the_error_decide(value, error, scale, text):
    assert with_error(value, error, scale) == text


def test_a_terminal_has_its_own_sign():
    assert with_error(0.3514962, 0.02, sign="+-") == "0.351 +- 0.020"


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (0.3514962, 0.02, "0.351"),
        (4732400.0, 410000.0, "4.73e6"),
        (1.2189e-4, 2.6e-5, "1.22e-4"),
        (123456.0, 2345.0, "123500"),
        (0.64832, math.nan, "0.6483"),
        (math.nan, 0.1, "-"),
    ],
)
def test_a_value_in_a_column_of_its_own_has_the_digits_its_error_leaves(value, error, text):
    assert to_error(value, error) == text


def test_plain_and_signed():
    assert (format_number(0.123456), format_number(None), format_number(math.inf)) == ("0.1235", "-", "-")
    assert signed(0.5) == "+0.50"
    assert signed(-1e-5, 4) == signed(-0.0, 4) == "+0.0000"


@pytest.mark.parametrize(
    ("value", "text"), [(1772.18, "1770"), (0.597, "0.597"), (12345.0, "12300"), (2.645e13, "2.64e+13")]
)
def test_what_people_read_has_an_exponent_only_where_it_must(value, text):
    assert format_number(value, 3) == text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (293100.0, 9312.0, "9300"),
        (4.0e6, 3.96e5, "0.40e6"),
        (2.44e-4, 2.5e-5, "0.25e-4"),
        (0.9, 0.014, "0.014"),
    ],
)
def test_an_error_in_a_column_of_its_own_has_its_value_s_exponent(value, error, text):
    assert error_beside(value, error) == text
