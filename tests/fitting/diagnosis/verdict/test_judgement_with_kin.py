"""What is akin to explanations and in no catalogue, weighed with them."""

import numpy as np
import pytest
from verdict_cases import POOR_NONE, judged, scored

from fitting.diagnosis.thresholds import VERDICT
from fitting.diagnosis.verdict.judgement import judge
from fitting.diagnosis.verdict.kin import Kin


def with_kin(odds, *scored_fits, none=POOR_NONE, apart=0.0):
    def kin(one):
        found = odds.get(one.names)
        return None if found is None else Kin(found, np.zeros(1), np.zeros((1, 1)), np.zeros(1), apart)

    return judge(none, scored_fits, held_out=lambda one: 1.0, kin=kin)


@pytest.mark.parametrize(
    ("odds", "verdict"),
    [
        (0.9 / 19, "effect"),
        (1.1 / 19, "ambiguous"),
        (0.9 * VERDICT.kin_favoured, "ambiguous"),
        (1.1 * VERDICT.kin_favoured, "unknown"),
    ],
)
def test_what_may_be_akin_and_in_no_catalogue_is_not_certain_and_not_named_where_that_is_likelier(
    odds, verdict
):
    said = with_kin({("gain_error",): odds}, scored("gain_error", cost=0.0))
    assert said.verdict == verdict
    assert said.share_of_kin == pytest.approx(odds / (1 + odds))
    assert said.probability["gain_error",] == pytest.approx(1 / (1 + odds))
    if verdict == "unknown":
        assert said.refused == ("gain_error",)
        assert "in no catalogue" in said.why
    else:
        assert said.equivalent["gain_error"] == ("gain_error", "unlisted")[: 1 + (verdict == "ambiguous")]


@pytest.mark.parametrize("apart", [0.0, 0.3, 1.0])
def test_what_is_in_no_catalogue_may_leave_the_law_where_no_effect_does(apart):
    said = with_kin({("gain_error",): 0.25}, scored("gain_error", cost=0.0), apart=apart)
    listed, without, akin = said.weighing(POOR_NONE)
    assert [one.names for one, _ in (listed, without, akin)] == [("gain_error",), (), ("unlisted",)]
    assert [share for _, share in (listed, without, akin)] == pytest.approx(
        [0.8, 0.2 * apart / 2, 0.2 * (1 - apart / 2)]
    )
    # Where nothing else explains the readings half of it is there.
    alone = with_kin({("gain_error",): 1e9}, scored("gain_error", cost=0.0), apart=apart)
    assert [share for _, share in alone.weighing(POOR_NONE)] == [0.5, 0.5]


def test_kin_is_asked_of_what_nothing_refuses():
    refused, stands = scored("spot_offset", cost=0.0, fails=True), scored("gain_error", cost=3.0)
    said = with_kin({("spot_offset",): 1e9, ("gain_error",): 0.01}, refused, stands)
    assert said.accepted is stands
    assert [one.names for one, *_ in said.unlisted.of] == [("gain_error",)]
    # Where everything is refused nothing is named, and kin says what readings say of the law.
    alone = with_kin({("spot_offset",): 1e9}, refused)
    assert (alone.verdict, alone.accepted) == ("unknown", None)
    assert "once in" in alone.why
    assert alone.unlisted is not None


def test_where_nothing_may_be_named_kin_is_not_asked():
    said = with_kin({("spot_offset",): 1e9}, scored("spot_offset", cost=9.0), none=scored(cost=0.0))
    assert (said.verdict, said.unlisted, said.share_of_kin) == ("none", None, 0.0)


def test_kin_of_several_explanations_adds_up_and_leaves_their_order():
    each = scored("gain_error", cost=0.0), scored("spot_offset", cost=1.0)
    plain, said = judged(POOR_NONE, *each), with_kin({("gain_error",): 0.1, ("spot_offset",): 0.2}, *each)
    first, second = (plain.probability[one.names] for one in each)
    beside = 0.1 * first + 0.2 * second
    assert said.share_of_kin == pytest.approx(beside / (1 + beside))
    assert said.probability["gain_error",] / said.probability["spot_offset",] == pytest.approx(first / second)
    assert sum(part for *_, part in said.unlisted.of) == pytest.approx(1)
    # In cost it stands where its probability does.
    apart = said.unlisted.cost - each[0].cost
    assert np.exp(-apart / 2) == pytest.approx(said.share_of_kin / said.probability["gain_error",])


def test_kin_of_what_shares_with_a_stand_in_is_worth_no_more_for_that():
    """A resonance of the fixture fits far better; the other one's share is by rule, and its kin's is not."""
    best = scored("fixture_resonance", cost=0.0, stands_in="of anything")
    other = scored("loose_part", cost=140.0)
    said = with_kin({("fixture_resonance",): 1e-6, ("loose_part",): 200.0}, best, other)
    assert said.verdict == "ambiguous"
    assert said.probability["loose_part",] == pytest.approx(1 - VERDICT.stand_in, rel=1e-3)
    assert said.share_of_kin == pytest.approx(1e-6, rel=1e-3)


def test_kin_is_held_against_all_that_is_listed():
    """Pairs that share an effect part its probability: what is like that effect is no likelier for it."""
    pairs = [
        scored("base_rocking", other, cost=0.0) for other in ("ac_coupling", "loose_part", "spot_offset")
    ]
    said = with_kin({one.names: 1.0 for one in pairs}, *pairs)
    assert said.share_of_kin == pytest.approx(0.5)
    assert said.verdict == "ambiguous"
    assert said.equivalent["base_rocking"] == ("base_rocking", "unlisted")
