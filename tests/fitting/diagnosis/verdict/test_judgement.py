"""Trials weighed: what is named, what stands beside it, what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from verdict_cases import POOR_NONE, judged, scored

from fitting.diagnosis.thresholds import VERDICT
from fitting.diagnosis.verdict.judgement import beside_another_law, judged_by_hand
from fitting.diagnosis.verdict.names import NONE
from fitting.effects import CATALOGUE

EVEN = 2 * np.log(VERDICT.credible / (1 - VERDICT.credible))
"""In cost: so far below another, an explanation has just the probability that is asked for."""


NAMED = -2 * np.log(VERDICT.favoured)
"""In cost: so far below none, an effect that stands alone is named; here it may be above."""


@pytest.mark.parametrize(
    ("gain", "verdict"), [(NAMED - 0.1, "none"), (NAMED + 0.1, "ambiguous"), (1.1 * EVEN, "effect")]
)
def test_an_effect_is_named_where_none_is_hardly_likelier(gain, verdict):
    said = judged(scored(cost=100.0), scored("spot_offset", cost=100.0 - gain))
    assert said.verdict == verdict
    assert (said.accepted is not None) == (verdict != "none")
    # That nothing is there stays in the group while it has more than 5 %.
    assert (
        said.equivalent
        == {
            "none": {},
            "ambiguous": {"spot_offset": ("spot_offset", NONE)},
            "effect": {"spot_offset": ("spot_offset",)},
        }[verdict]
    )


@pytest.mark.parametrize(("count", "verdict"), [(6, "none"), (len(CATALOGUE), "ambiguous")])
def test_where_none_is_improbable_an_effect_is_named_though_each_is_less_likely(count, verdict):
    each = [scored(name, cost=2 * np.log(2 * VERDICT.favoured)) for name in list(CATALOGUE)[:count]]
    said = judged(scored(cost=0.0), *each)
    assert said.verdict == verdict
    assert (said.probability[()] > VERDICT.least_doubted) == (verdict == "none")


def test_where_nothing_is_needed_nothing_is_named():
    said = judged(scored(cost=0.0), scored("spot_offset", cost=9.0), scored("gain_error", cost=11.0))
    assert (said.verdict, said.accepted, said.equivalent) == ("none", None, {})
    assert said.probability[()] > 0.95


@pytest.mark.parametrize(("behind", "verdict"), [(0.9 * EVEN, "ambiguous"), (1.1 * EVEN, "effect")])
def test_the_group_holds_every_explanation_up_to_95_percent(behind, verdict):
    said = judged(POOR_NONE, scored("gain_error", cost=0.0), scored("spot_offset", cost=behind))
    assert said.verdict == verdict
    assert said.accepted.names == ("gain_error",)
    assert ("spot_offset" in said.equivalent["gain_error"]) == (verdict == "ambiguous")
    assert len(said.group) == (2 if verdict == "ambiguous" else 1)


def test_many_that_are_each_improbable_may_hold_the_last_five_percent_together():
    others = ("spot_offset", "core_thickness", "channel_delay", "added_mass")
    costs = dict.fromkeys(others, EVEN + 1.0)
    said = judged(POOR_NONE, scored("gain_error", cost=0.0), *(scored(n, cost=c) for n, c in costs.items()))
    assert said.verdict == "ambiguous"
    assert said.probability[("gain_error",)] < 0.95 < sum(p for p in said.probability.values())


COSTS = st.lists(st.floats(0, 30), min_size=1, max_size=8)


@given(COSTS, st.floats(0, 30))
def test_probabilities_add_up_to_one_and_the_group_is_the_smallest_of_95_percent(costs, none):
    names = sorted(CATALOGUE)[: len(costs)]
    said = judged(scored(cost=none), *(scored(n, cost=c) for n, c in zip(names, costs, strict=True)))
    assert sum(said.probability.values()) == pytest.approx(1)
    assert sum(share for _, share in said.group) == pytest.approx(1)
    held = [said.probability[t.names] for t, _ in said.group]
    assert sum(held) >= VERDICT.credible - 1e-12
    assert sum(held[:-1]) < VERDICT.credible
    assert held == sorted(held, reverse=True)
    assert sum(said.of_effect(n) for n in names) == pytest.approx(1 - said.probability[()])


def test_of_several_fits_of_one_explanation_the_best_counts():
    said = judged(POOR_NONE, *(scored("gain_error", cost=c) for c in (3.0, 0.0, 1.0)))
    assert set(said.probability) == {(), ("gain_error",)}
    assert said.accepted.cost == 0.0
    pair = [scored("gain_error", "added_mass", cost=2.0), scored("added_mass", "gain_error", cost=0.0)]
    assert judged(POOR_NONE, *pair).accepted is pair[1]


def test_where_all_that_may_be_named_fail_nothing_is_accepted_and_the_nearest_is_said():
    said = judged(POOR_NONE, scored("gain_error", cost=0.0, fails=True))
    assert (said.verdict, said.accepted, said.refused) == ("unknown", None, ("gain_error",))
    assert "signs" in said.why
    both = scored("gain_error", cost=0.0, fails=True), scored("spot_offset", cost=1.0, fails=True)
    assert judged(POOR_NONE, *both).verdict == "unknown"


def test_what_comes_beside_the_best_does_not_stand_for_it():
    """More damping beside a clamp that yields and beside a clamp line: only the line stands for it."""
    said = judged(
        POOR_NONE,
        scored("clamp_compliance", cost=0.0),
        scored("clamp_compliance", "viscous_damping", cost=1.0),
        scored("clamp_line", "viscous_damping", cost=2.0),
    )
    assert said.verdict == "ambiguous"
    assert said.equivalent == {"clamp_compliance": ("clamp_compliance", "clamp_line")}


def test_alone_it_does_stand_for_it():
    said = judged(
        POOR_NONE,
        scored("clamp_compliance", cost=0.0),
        scored("clamp_compliance", "viscous_damping", cost=1.0),
        scored("viscous_damping", cost=2.0),
    )
    assert said.equivalent == {"clamp_compliance": ("clamp_compliance", "viscous_damping")}


def test_what_comes_beside_another_of_the_group_does_not_stand_for_the_best_either():
    """More damping beside a clamp that rubs: it is the friction that may be there instead."""
    said = judged(
        POOR_NONE,
        scored("clamp_compliance", cost=0.0),
        scored("clamp_friction", cost=1.0),
        scored("clamp_friction", "viscous_damping", cost=2.0),
    )
    assert said.equivalent == {"clamp_compliance": ("clamp_compliance", "clamp_friction")}


def test_where_both_of_a_pair_are_exchanged_each_stands_for_what_it_stands_for_alone():
    said = judged(
        POOR_NONE,
        scored("clamp_compliance", "sensor_lowpass", cost=0.0),
        scored("clamp_compliance", "channel_delay", cost=0.5),
        scored("clamp_line", "channel_delay", cost=1.0),
    )
    assert said.equivalent == {
        "clamp_compliance": ("clamp_compliance", "clamp_line"),
        "sensor_lowpass": ("sensor_lowpass", "channel_delay"),
    }


def test_where_nothing_is_known_of_both_each_may_stand_for_either():
    pair = scored("clamp_compliance", "sensor_lowpass", cost=0.0)
    said = judged(POOR_NONE, pair, scored("clamp_line", "channel_delay", cost=0.5))
    for name in pair.names:
        assert set(said.equivalent[name]) == {name, "clamp_line", "channel_delay"}


def test_what_comes_beside_one_of_the_best_stands_for_the_other_though_that_one_may_do_alone():
    said = judged(
        POOR_NONE,
        scored("base_rocking", "partial_debond", cost=0.0),
        scored("base_rocking", "graded_core", cost=1.0),
        scored("base_rocking", cost=1.5),
    )
    assert said.equivalent == {
        "base_rocking": ("base_rocking",),
        "partial_debond": ("partial_debond", "graded_core"),
    }


def test_one_of_the_group_that_passes_is_enough():
    every = scored("gain_error", cost=0.0, fails=True), scored("spot_offset", cost=1.0)
    said = judged(POOR_NONE, *every)
    assert said.verdict == "ambiguous"
    assert said.accepted is every[1]
    assert set(said.equivalent["spot_offset"]) == {"gain_error", "spot_offset"}
    far = scored("gain_error", cost=0.0, fails=True), scored("spot_offset", cost=2 * EVEN)
    assert judged(POOR_NONE, *far).verdict == "unknown"


def test_what_is_unlikely_without_any_effect_but_no_effect_explains_is_unknown():
    fails = scored(cost=0.0, fails=True)
    assert judged(fails, scored("gain_error", cost=5.0)).verdict == "unknown"
    assert judged(scored(cost=0.0), scored("gain_error", cost=5.0)).verdict == "none"


def test_a_second_effect_that_is_not_needed_leaves_the_first_alone():
    """Every explanation of the group has the delay: it is there, whatever stands beside it."""
    said = judged(
        POOR_NONE, scored("channel_delay", cost=0.0), scored("channel_delay", "spot_offset", cost=1.0)
    )
    assert (said.verdict, said.accepted.names) == ("effect", ("channel_delay",))
    assert said.of_effect("channel_delay") == pytest.approx(1)
    assert said.of_effect("spot_offset") == pytest.approx(1 / (1 + np.exp(0.5)))


def test_each_effect_of_a_pair_has_its_own_equals():
    pair = scored("channel_delay", "spot_offset", cost=0.0)
    said = judged(POOR_NONE, pair, scored("channel_delay", "gain_error", cost=1.0))
    assert said.verdict == "ambiguous"
    assert said.accepted is pair
    assert said.equivalent["channel_delay"] == ("channel_delay",)
    assert set(said.equivalent["spot_offset"]) == {"spot_offset", "gain_error"}


def test_another_explanation_altogether_stands_for_all_of_a_pair():
    said = judged(POOR_NONE, scored("channel_delay", "spot_offset", cost=0.0), scored("added_mass", cost=1.0))
    assert said.verdict == "ambiguous"
    for name in ("channel_delay", "spot_offset"):
        assert set(said.equivalent[name]) == {name, "added_mass"}


@pytest.mark.parametrize(("off", "none_off"), [(1.1 * VERDICT.poor, 1.0), (10.0, 15.0)])
def test_another_law_that_does_not_predict_is_refused(off, none_off):
    law = scored("core_law", cost=0.0)
    said = judged(POOR_NONE, law, off={("core_law",): off, (): none_off})
    assert (said.verdict, said.refused) == ("unknown", ("core_law",))
    assert "not seen" in said.why
    assert (
        judged(POOR_NONE, law, off={("core_law",): off, (): 1.1 * off / VERDICT.hardly_better}).verdict
        == "effect"
    )
    assert judged(POOR_NONE, law, off={("core_law",): 0.9 * VERDICT.poor, (): none_off}).verdict == "effect"


@pytest.mark.parametrize(("off", "verdict"), [(2.0, "effect"), (3.0, "ambiguous"), (np.nan, "ambiguous")])
def test_two_effects_are_sure_only_where_they_predict_what_was_held_out(off, verdict):
    names = ("fixture_resonance", "base_roll")
    said = judged(POOR_NONE, scored(*names, cost=0.0), off={names: off, (): 2.8})
    assert (said.verdict, said.accepted.names) == (verdict, names)
    assert said.confirmed == (verdict == "effect")


def test_what_two_segments_cannot_place_is_believed_all_the_same():
    said = judged(POOR_NONE, scored("added_mass", cost=0.0), off={("added_mass",): 30.0})
    assert said.verdict == "effect"


def test_what_someone_has_decided_stands_for_itself():
    said = judged_by_hand(scored("gain_error", "channel_delay", cost=5.0))
    assert (said.verdict, said.by_hand) == ("effect", True)
    assert said.equivalent == {"gain_error": ("gain_error",), "channel_delay": ("channel_delay",)}
    assert (judged_by_hand(scored(cost=5.0)).verdict, judged_by_hand(scored(cost=5.0)).accepted) == (
        "none",
        None,
    )


def test_what_no_point_shows_by_itself_shares_with_what_nothing_refuses():
    fixture = scored("fixture_resonance", cost=0.0, stands_in="not seen")
    law, tether = scored("core_law", cost=80.0), scored("tether", cost=81.0, fails=True)
    said = judged(POOR_NONE, fixture, law, tether)
    assert (said.verdict, said.accepted) == ("ambiguous", fixture)
    assert said.equivalent == {"fixture_resonance": ("fixture_resonance", "core_law")}
    assert said.of_effect("fixture_resonance") == pytest.approx(VERDICT.stand_in)
    assert judged(POOR_NONE, scored("fixture_resonance", cost=0.0), law, tether).verdict == "effect"
    # Where everything else is refused there is nothing to share with.
    assert judged(POOR_NONE, fixture, tether).verdict == "effect"


@given(COSTS, st.lists(st.booleans(), min_size=8, max_size=8), st.floats(0, 2000))
def test_who_may_stand_in_is_doubted_and_that_there_is_an_effect_is_not(costs, unseen, none):
    names = sorted(CATALOGUE)[: len(costs)]
    some = [
        scored(n, cost=c, stands_in="not seen" * u) for n, c, u in zip(names, costs, unseen, strict=False)
    ]
    said = judged(scored(cost=none), *some)
    certain = judged(scored(cost=none), *(scored(n, cost=c) for n, c in zip(names, costs, strict=True)))
    assert said.probability[()] == pytest.approx(certain.probability[()], abs=1e-12)
    assert sum(said.probability.values()) == pytest.approx(1)
    if any(t.stands_in for t in some) and not all(t.stands_in for t in some):
        share = sum(said.probability[t.names] for t in some if t.stands_in)
        assert share <= VERDICT.stand_in * (1 - said.probability[()]) + 1e-12


def test_beside_another_what_stands_in_is_never_certain():
    names = ("fixture_resonance", "gain_error")
    pair = scored(*names, cost=0.0, stands_in="not seen")
    said = judged(POOR_NONE, pair, off={names: 1.0, (): 9.0})
    assert (said.verdict, said.accepted.names, said.confirmed) == ("ambiguous", names, True)
    assert judged(POOR_NONE, scored("added_masses", cost=0.0)).verdict == "effect"


def test_three_things_at_once_are_named_beside_what_stands_and_never_alone():
    pair = scored("added_masses", "spot_offset", cost=0.0, stands_in="so many things")
    alone = judged(POOR_NONE, pair, off={pair.names: 1.0, (): 9.0})
    assert (alone.verdict, alone.refused) == ("unknown", pair.names)
    assert alone.why == "supposes three things at once, which come near to anything"
    beside = judged(POOR_NONE, pair, scored("added_mass", "spot_offset", cost=1.0))
    assert (beside.verdict, beside.accepted.names) == ("ambiguous", ("added_mass", "spot_offset"))


def test_of_two_effects_none_may_be_larger_than_is_plausible():
    how = {"stands_in": "too large", "too_large": "added_mass"}
    pair = scored("added_mass", "gain_error", cost=0.0, **how)
    alone = judged(POOR_NONE, pair, off={pair.names: 1.0, (): 9.0})
    assert (alone.verdict, alone.refused) == ("unknown", pair.names)
    assert alone.why == "has more of added_mass than is plausible"
    beside = judged(POOR_NONE, pair, scored("spot_offset", cost=1.0))
    assert (beside.verdict, beside.accepted.names) == ("ambiguous", ("spot_offset",))
    # A single one that is far larger than usual may be just that, and is not certain.
    single = judged(POOR_NONE, scored("added_mass", cost=0.0, **how))
    assert (single.verdict, single.accepted.names) == ("ambiguous", ("added_mass",))


@pytest.mark.parametrize(("p", "verdict"), [(0.02, "effect"), (0.005, "ambiguous"), (5e-5, "unknown")])
def test_what_has_stated_numbers_further_off_than_they_are_is_not_certain(p, verdict):
    said = judged(POOR_NONE, scored("spot_offset", cost=0.0, tolerances=p))
    assert said.verdict == verdict
    if verdict == "ambiguous":
        assert said.equivalent == {"spot_offset": ("spot_offset",)}


@pytest.mark.parametrize(("unsized", "verdict"), [(False, "effect"), (True, "ambiguous")])
def test_two_effects_of_which_one_has_no_size_are_not_sure(unsized, verdict):
    pair = scored("loose_part", "phase_scale", cost=0.0, unsized=unsized)
    found = judged(POOR_NONE, pair, off={(): 9.0})
    assert found.verdict == verdict
    assert found.accepted is pair


def test_another_law_is_not_told_from_what_data_show_as_one():
    said = judged(POOR_NONE, scored("core_law", cost=0.0))
    assert said.verdict == "effect"
    beside = beside_another_law(said, ("amplitude_softening",))
    assert (beside.verdict, beside.equivalent) == (
        "ambiguous",
        {"core_law": ("core_law", "amplitude_softening")},
    )
    assert beside_another_law(said, ()) is said
    gain = judged(POOR_NONE, scored("gain_error", cost=0.0))
    assert beside_another_law(gain, ("amplitude_softening",)) is gain
