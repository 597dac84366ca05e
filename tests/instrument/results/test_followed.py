"""The story of what was measured after a diagnosis, from the events of a session."""

from diagnosis_cases import diagnosis
from following_cases import BACKWARDS, SPOT

from instrument.facts.follow_up import FollowUp
from instrument.results.followed import followed_lines, followed_of, measured_words
from instrument.stream.derived import DiagnosisFound
from instrument.stream.raw import FollowUpDecided, FollowUpProposed

OFFERS = tuple(FollowUp.model_validate(o) for o in (BACKWARDS, SPOT))
FOUND = DiagnosisFound(1, 10, diagnosis())
NOTHING = DiagnosisFound(2, 20, None, "too few points")


def test_the_offer_that_was_taken_stands_between_both_verdicts():
    events = [
        FOUND,
        FollowUpProposed(1, 1, OFFERS),
        FollowUpDecided(1, 0, False, "person"),
        FollowUpDecided(1, 1, True, "person"),
        NOTHING,
    ]
    (one,) = followed_of(events)
    assert one.measured == OFFERS[1]
    assert one.verdict_before.startswith("effect: added_mass")
    assert one.verdict_after == "no diagnosis: too few points"
    assert followed_lines([one]) == [
        f"before: {one.verdict_before}",
        "measured, to tell spot_offset and gain_error apart (1 of 1): Aim it elsewhere; 3 steps",
        "after: no diagnosis: too few points",
    ]


def test_what_was_not_diagnosed_again_says_so():
    events = [FOUND, FollowUpProposed(1, 1, OFFERS), FollowUpDecided(1, 0, True, "experiment")]
    assert followed_lines(followed_of(events))[-1] == "after: not diagnosed"


def test_nothing_was_measured_where_everything_was_declined():
    events = [FOUND, FollowUpProposed(1, 1, OFFERS), FollowUpDecided(1, 0, False, "person")]
    assert followed_of(events) == ()


def test_a_hammer_test_has_no_steps():
    hammer = OFFERS[0].but(kind="bare_hammer", frequencies_hz=(), segments=())
    assert measured_words(hammer) == "Do it"
