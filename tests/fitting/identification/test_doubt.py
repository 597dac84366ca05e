"""Remarks by which a fit's law may be wrong."""

import pickle

from fitting.identification.doubt import ASTRAY, BIASED, Doubt, doubts_among


def test_what_is_a_doubt_is_its_kind_and_not_its_words():
    said = (Doubt("the plate is not this one"), f"{BIASED}, {ASTRAY} data", "hardly known above 300 Hz")
    assert doubts_among(said) == ("the plate is not this one",)
    assert [type(one) for one in doubts_among(said)] == [str]


def test_a_doubt_goes_where_strings_go_and_stays_one():
    said = Doubt("the plate is not this one")
    assert said == "the plate is not this one"
    assert doubts_among(pickle.loads(pickle.dumps((said,)))) == (said,)
    assert doubts_among((f"file 1: {said}",)) == ()
