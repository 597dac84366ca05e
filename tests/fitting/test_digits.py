"""Numbers in sentences are written out."""

import pytest

from fitting.digits import all_digits, band, seldom, tail, times, two_digits, written_out


@pytest.mark.parametrize(
    ("value", "said"),
    [(634.0, "630"), (99.8, "100"), (104.0, "100"), (15.2, "15"), (0.383, "0.38"), (0.0, "0"), (-3.04, "-3")],
)
def test_a_number_has_two_digits_and_no_exponent(value, said):
    assert two_digits(value) == said


def test_a_number_of_five_figures_is_written_out_with_its_digits():
    assert written_out(97352.0, 3) == "97400"
    assert written_out(0.1384, 3) == "0.138"


def test_zeros_at_the_end_are_kept_where_numbers_stand_beside_each_other():
    assert [all_digits(v, 4) for v in (0.3275, 0.303, 7.0391, 1234.0)] == [
        "0.3275",
        "0.3030",
        "7.039",
        "1234",
    ]


def test_odds_are_said_as_how_many_times_as_likely():
    assert [times(x) for x in (0.0, 0.7, 3.0, 9.2)] == ["1.0 times", "2.0 times", "20 times", "9900 times"]
    assert times(200.0) == "over 10^86 times"


@pytest.mark.parametrize(
    ("chance", "said"),
    [
        (0.0029, "once in 340 times"),
        (1e-99, "once in more than a million times"),
        (0.0, "once in more than a million times"),
    ],
)
def test_a_chance_too_small_to_mean_anything_has_no_digits(chance, said):
    assert seldom(chance) == said


def test_a_p_value_is_never_nought():
    assert [tail(p) for p in (0.0, 9e-4, 0.00123, 0.5)] == ["< 0.001", "< 0.001", "0.0012", "0.5"]


def test_a_range_that_is_one_frequency_is_said_as_one():
    assert [band(478.01, 478.04), band(20.0, 280.0)] == ["478 Hz", "20 to 280 Hz"]
