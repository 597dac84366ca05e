"""What is advised, in words: the same numbers as in its row."""

from typing import get_args

import pytest
from diagnosis_cases import diagnosis
from following_cases import SPOT

from instrument.facts.follow_up import FollowUp, FollowUpKind
from instrument.results.next_words import (
    NEXT_COLUMNS,
    advice,
    beyond_words,
    may_settle,
    next_row,
    separated_words,
)

OFFER = FollowUp.model_validate(SPOT)


def test_the_advice_says_which_measurement_why_and_what_it_costs():
    assert advice(OFFER) == (
        "To tell spot_offset and gain_error apart, aim it elsewhere. A gain is the same at every spot. "
        "It takes 30 s and, if one of these is true, settles the matter with 80 % chance."
    )


def test_the_advice_says_what_follows_where_it_settles_nothing():
    after = advice(OFFER.but(then="bare_hammer"))
    assert after.endswith("with 80 % chance; if not, the bare plate's hammer test should follow.")


def test_what_settles_nothing_promises_nothing_and_what_takes_long_takes_minutes():
    vain = OFFER.but(probability_resolved=0.004, seconds=209.0)
    assert advice(vain).endswith(" It takes 3 min.")
    assert advice(vain.but(then="bare_hammer")).endswith(
        " It takes 3 min; then the bare plate's hammer test should follow."
    )
    assert not may_settle(vain)
    assert may_settle(OFFER)
    assert dict(zip(NEXT_COLUMNS, next_row(vain), strict=True))["rig and hands"] == "3 min"


def test_every_measurement_has_words_to_follow_by():
    for kind in get_args(FollowUpKind):
        assert advice(OFFER.but(then=kind)).endswith("should follow.")


def test_a_row_has_a_cell_under_every_heading():
    assert dict(zip(NEXT_COLUMNS, next_row(OFFER), strict=True))["settles it"] == "80 %"
    far = next_row(OFFER.but(separation=5e5))
    assert dict(zip(NEXT_COLUMNS, far, strict=True))["likelier by"] == "over 10^6 times"


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (("a", "b", "none"), "a, b and no effect"),
        (("a", "none"), "a and no effect"),
        (("a", "b", "c", "d"), "a, b, c and d"),
        (("a", "b", "c", "d", "none"), "a, b, c and 2 more"),
    ],
)
def test_explanations_are_listed_as_one_would_say_them(names, said):
    assert separated_words(names) == said


def test_all_are_listed_where_there_is_room():
    assert separated_words("abcdef", most=6) == "a, b, c, d, e and f"


def test_what_a_measurement_tells_apart_beyond_the_verdict_is_said_with_its_share():
    found = diagnosis(verdict="ambiguous")

    def said(*between):
        return beyond_words(found.but(next_measurements=(OFFER.but(between=between),)))

    named = ("added_mass", "spot_offset")
    assert said(*named) == ""
    assert beyond_words(found) == ""
    # What was fitted in no form has no share.
    assert said(*named, "gain_error").endswith("told apart too: gain_error.")
    first, *rest = found.candidates
    likely = found.but(candidates=(first, *rest, first.but(name="clamp_line", probability=0.013)))
    (offer,) = (OFFER.but(between=(*named, "clamp_line", "none")),)
    assert beyond_words(likely.but(next_measurements=(offer,))) == (
        "Less likely than what the verdict names, and told apart too: "
        "clamp_line and no effect (1.3 % together)."
    )
    assert beyond_words(likely.but(next_measurements=(offer,), equivalent={})) == ""
