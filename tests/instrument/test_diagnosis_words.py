"""Probabilities and doubt in words."""

import numpy as np
import pytest

from instrument.diagnosis_words import log_odds, probability_words, resampling_words, with_verdict


@pytest.mark.parametrize(
    ("p", "said"),
    [
        (0.9876, "98.8 %"),
        (0.002, "0.2 %"),
        (1e-5, "< 0.1 %"),
        (0.9999, "> 99.9 %"),
        (None, "-"),
        (np.nan, "-"),
    ],
)
def test_a_probability(p, said):
    assert probability_words({"probability": p}, {}) == said


def test_nothing_was_weighed_by_hand_nor_before_there_were_probabilities():
    assert probability_words({"probability": 1.0}, {"by_hand": True}) == "-"
    assert probability_words({}, {}) == "-"


def test_a_law_of_an_unknown_cause_says_so():
    assert with_verdict("the law", {"verdict": "unknown"}) == "the law (verdict unknown)"
    assert with_verdict("the law", {"verdict": "effect"}) == "the law"


def test_odds_are_against_none():
    costs = [{"name": "a", "delta_bic": 0.0}, {"name": "none", "delta_bic": 8.0}]
    assert log_odds({"candidates": costs}) == [4.0, 0.0]
    assert log_odds({"candidates": costs[:1]}) == [None]


def test_resampling_is_said_where_it_was_done():
    assert resampling_words({"p_value": None}) == ""
    said = resampling_words({"p_value": 0.05, "nested_held_out_rms_percent": 2.345})
    assert said == (
        "sweeps without any effect gain as much in 5 % of cases; "
        "data left out, the whole search repeated without them: 2.3 % rms"
    )
