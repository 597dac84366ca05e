from instrument.facts.diagnosis import ParameterFound
from instrument.results.diagnosis_words import parameter_words
from instrument.results.error_words import percent_words, ratio_error_words, ratio_words


def test_an_error_below_the_models_own_is_not_said_as_a_number():
    assert percent_words(4e-8, 1.0) == "below 0.01"
    assert percent_words(0.02, -1.0) == "2"
    assert percent_words(float("nan"), 1.0) == "-"
    said = parameter_words("tau_s", ParameterFound(value=1.0, standard_error=4e-8, unit="s"))
    assert said == "tau_s 1 (+- below 0.01 %) s"


def test_a_ratio_known_better_than_that_has_as_many_digits_as_it_is_worth():
    assert ratio_words(2.9e-3, 1e-9) == "0.2900 +- below 0.0001"
    assert ratio_words(0.1, 1e-9, "±") == "10.000 ± below 0.001"
    assert ratio_words(2.9e-3, 2e-5) == "0.2900 +- 0.0020"
    assert [ratio_error_words(2.9e-3, e) for e in (1e-9, 2e-5)] == ["below 0.0001", "0.002"]
