"""Which offers fit into a run, and the steps that one is."""

import pytest
from following_cases import BACKWARDS, HALF, OFFER, SPOT, STRUCK, STRUCK_IN_ITS_CLAMP
from sessions import point

from drivers.vibrometer import Range
from instrument.facts.follow_up import FollowUp
from instrument.run.follow_up_steps import MOST_OFFERS, clamped_again, follow_up_segments, possible
from instrument.stepped_sine.settings import Limits

POINTS = [point(k, f, segment=s, range_name=r) for k, f, s, r in ((1, 96.0, 1, "a"), (2, 185.0, 2, "b"))]


def offer(given, **changes):
    return FollowUp.model_validate({**given, **changes})


def kinds(offers, **changes):
    given = {"most_s": 100.0, "can_strike": False, **changes}
    return [o.kind for o in possible(offers, POINTS, given.pop("limits", Limits()), **given)]


def test_what_takes_too_long_or_no_run_can_do_is_left_out():
    offers = [offer(SPOT, seconds=101.0), offer(OFFER, kind="damped_struck"), offer(BACKWARDS)]
    assert kinds(offers) == ["reversed"]


@pytest.mark.parametrize(
    ("held", "left"), [((), []), (("clamped",), ["clamped"]), (("clamped", "free"), ["free", "clamped"])]
)
def test_the_damped_plate_is_struck_as_it_can_be_held_here(held, left):
    offers = [offer(STRUCK), offer(STRUCK_IN_ITS_CLAMP)]
    found = possible(offers, POINTS, Limits(), most_s=1000.0, can_strike=False, held=held)
    assert [o.held for o in found] == left
    for one in found:
        assert "strike it at (285, 180) mm" in one.todo
        assert ("hang it" in one.todo) == (one.held == "free")


def test_what_hung_is_clamped_at_its_mark():
    again = clamped_again(offer(STRUCK))
    assert (again.kind, again.held, again.spot_mm, again.struck_mm) == ("clamping", None, None, None)
    assert "at its mark" in again.todo


@pytest.mark.parametrize("can", [True, False])
def test_a_hammer_test_is_offered_where_there_is_one_to_make(can):
    assert kinds([offer(OFFER, kind="bare_hammer")], can_strike=can) == ["bare_hammer"] * can


def test_a_level_that_comes_near_a_limit_is_left_out():
    p = POINTS[0]
    top = max(abs(p.velocity_m_s) for p in POINTS)
    more = offer(HALF, level_g=1.5 * p.level_m_s2 / 9.81)
    assert kinds([more]) == ["level"]
    assert kinds([more], limits=Limits(velocity_m_s=1.8 * top)) == []
    assert kinds([offer(HALF, level_g=6.0)], limits=Limits(base_m_s2=50.0)) == []


def test_another_spot_is_read_in_the_range_that_has_room_for_what_is_foreseen():
    ranges = (Range("fine", 0.01, 2.0, 1e5, None, True), Range("coarse", 0.1, 2.0, 1e5, None, True))
    given = offer(SPOT, frequencies_hz=[95.0, 97.0, 186.0], segments=[1, 1, 2])
    foreseen = given.but(velocities_m_s=(0.001, 0.1, 0.002))
    assert [s.range_name for s in follow_up_segments(foreseen, POINTS, 3, ranges)] == ["coarse", "fine"]
    assert [s.range_name for s in follow_up_segments(given, POINTS, 3, ranges)] == ["a", "b"]
    assert kinds([foreseen]) == ["spot"]
    assert kinds([foreseen], limits=Limits(velocity_m_s=0.11)) == []


def test_a_few_are_enough():
    assert len(kinds([offer(BACKWARDS)] * 9)) == MOST_OFFERS


def test_steps_stay_in_their_order_and_in_the_range_they_were_read_in():
    given = offer(BACKWARDS, frequencies_hz=[186.0, 95.0, 97.0, 95.0], segments=[2, 1, 1, 1])
    planned = follow_up_segments(given, POINTS, 3)
    assert [(s.segment, s.sweep, s.frequencies_hz, s.range_name) for s in planned] == [
        (2, 3, (186.0,), "b"),
        (1, 3, (95.0, 97.0), "a"),
    ]
    assert planned[0].level_m_s2 == pytest.approx((9.81,), rel=1e-3)
