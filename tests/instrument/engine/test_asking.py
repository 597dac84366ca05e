"""What a client is asked of a measurement that needs hands: with a place to draw, and answered."""

import pytest
from following_cases import BACKWARDS, CLAMPING, MASS, MASS_MM, SPOT, SPOT_MM

from instrument.engine.asking import RemoteOperator
from instrument.engine.messages import Answered
from instrument.facts.follow_up import FollowUp


def asked(offer, answer):
    """What goes out for an offer, and what comes of the answer."""
    sent = []

    def put(message):
        sent.append(message)
        operator.answer(Answered(answer))

    operator = RemoteOperator(put, ask_content=False)
    found = FollowUp.model_validate(offer)
    said = operator.change(found) if answer == "changed" else operator.agree(found)
    (message,) = sent
    return message, said


@pytest.mark.parametrize(
    ("offer", "at_mm", "mark"),
    [(SPOT, SPOT_MM, "laser"), (MASS, MASS_MM, "5 g"), (CLAMPING, None, "clamp")],
)
def test_hands_are_asked_with_where_to_and_what(offer, at_mm, mark):
    message, did = asked(offer, "changed")
    assert (message.what, message.detail, message.at_mm, message.mark) == (
        "change",
        offer["todo"],
        at_mm,
        mark,
    )
    assert (did.what, did.detail) == ("changed", offer["todo"])


@pytest.mark.parametrize(("answer", "agreed"), [("agreed", True), ("declined", False)])
def test_an_offer_is_asked_with_its_reason_and_its_chance_and_may_be_declined(answer, agreed):
    message, said = asked(BACKWARDS, answer)
    assert BACKWARDS["why"] in message.detail
    assert "80 % that one explanation is left" in message.detail
    assert said is agreed
