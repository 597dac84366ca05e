"""Sizes of effects as a workshop says them."""

import math

import pytest

from instrument.facts.diagnosis import ParameterFound
from instrument.results.diagnosis_words import parameter_words
from instrument.results.units_shown import shown_in, without_rounding


@pytest.mark.parametrize(
    ("unit", "shown"), [("m", (1e3, "mm")), ("kg", (1e3, "g")), ("1", (1.0, "")), ("N/m^3", (1.0, "N/m^3"))]
)
def test_lengths_are_in_millimetres_and_masses_in_grams(unit, shown):
    assert shown_in(unit) == shown


def test_a_parameter_with_its_error_is_in_these_units():
    one = ParameterFound(value=0.002188, standard_error=2.9e-5, unit="m")
    assert parameter_words("dlength", one) == "dlength 2.188 +- 0.029 mm"
    sharp = ParameterFound(value=0.02, standard_error=1e-7, unit="kg")
    assert parameter_words("mass", sharp) == "mass 20 (+- below 0.01 %) g"


@pytest.mark.parametrize(
    ("value", "unit", "said"), [(3.2e-9, "m", "y 0 mm"), (1e-16, "1", "y 0"), (3e-9, "s", "y 3e-09 s")]
)
def test_what_rounding_leaves_of_a_limit_at_zero_is_zero(value, unit, said):
    assert parameter_words("y", ParameterFound(value=value, standard_error=math.nan, unit=unit)) == said


def test_a_small_number_that_the_data_fix_stays():
    assert without_rounding(3e-9, 1e-9, "m") == 3e-9
