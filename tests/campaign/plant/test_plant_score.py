"""The score of made-up answers, by hand."""

import json
import math
from dataclasses import replace

import pytest

from campaign.plant.cases import draw
from campaign.plant.outcome import (
    Outcome,
    Said,
    StageFacts,
    law_errors_percent,
    line_of,
    outcome_of,
)
from campaign.plant.score import (
    answer,
    confusion,
    in_group,
    law_errors,
    of_hidden,
    right,
    score,
    scores,
)
from campaign.plant.tables import summary
from campaign.tables import markdown
from fitting.laws.fractional_zener import FractionalZener

BEFORE = StageFacts(9.0, 4.0, 5.0, 2, (10.0, -20.0, 30.0), (1.0, 1.0, -60.0))
AFTER = StageFacts(1.1, 0.9, 1.2, 0, (0.1, -0.2, 0.3), (0.4, 0.5, -0.6))


def said(verdict="none", effects=(), channels=(), **groups):
    equivalent = {name: tuple(group) for name, group in groups.items()}
    return Said(
        verdict, tuple(effects), tuple(channels), equivalent, (("none", 3.0, 1.1),), BEFORE, AFTER, 2.0, 1.0
    )


def outcome(kind, answered, truth=None, without=None, seed=1):
    if truth is None:
        truth = () if kind == "none" else (kind,)
    return Outcome(kind, seed, truth, False, 1, 1000.0, answered, without)


SPOT = outcome("spot_offset", said("effect", ["spot_offset"]))
GROUPED = outcome("gain_error", said("ambiguous", ["spot_offset"], spot_offset=["spot_offset", "gain_error"]))
TOO_WIDE = outcome(
    "gain_error",
    said("ambiguous", ["core_law"], core_law=["core_law", "gain_error", "added_mass", "spot_offset"]),
)
PAIR = ("spot_offset", "core_law")


@pytest.mark.parametrize(
    ("one", "is_right", "is_in_group"),
    [
        (SPOT, True, True),
        (GROUPED, False, True),
        (TOO_WIDE, False, False),
        (outcome("spot_offset", said("unknown")), False, False),
        (outcome("none", said()), True, True),
        (outcome("none", said("effect", ["gain_error"])), False, False),
        (outcome("none", said(channels=["mains_hum"])), False, False),
        (outcome("mains_hum", said(channels=["mains_hum"])), True, True),
        (outcome("mains_hum", said("effect", ["core_law"], ["mains_hum"])), False, False),
        (outcome("pair", said("effect", PAIR[::-1]), PAIR), True, True),
        (outcome("pair", said("effect", PAIR[:1]), PAIR), False, False),
        (outcome("pair", said("effect", ["gain_error", "core_law"]), PAIR), False, False),
        (
            outcome(
                "pair",
                said("ambiguous", ["gain_error", "core_law"], gain_error=["gain_error", "spot_offset"]),
                PAIR,
            ),
            False,
            True,
        ),
        (outcome("pair", said("effect", [*PAIR, "gain_error"]), PAIR), False, False),
    ],
)
def test_what_counts_as_right(one, is_right, is_in_group):
    assert right(one, one.said) == is_right
    assert in_group(one, one.said) == is_in_group


def test_one_group_does_not_stand_for_both_of_a_pair():
    both = {"core_law": ["core_law", "spot_offset"], "gain_error": ["gain_error", "added_mass"]}
    one = outcome("pair", said("ambiguous", ["core_law", "gain_error"], **both), PAIR)
    assert not in_group(one, one.said)


def test_what_is_never_hidden_takes_nothing_from_what_is():
    candidates = (("spot_offset + tether", 0.0, 1.0), ("gain_error", 4.0, 1.0), ("sensor_lowpass", 2.0, 1.0))
    one = replace(said("ambiguous", ["spot_offset", "tether"]), candidates=(*candidates, ("none", 9.0, 1.0)))
    assert of_hidden(outcome("gain_error", one), one)
    assert not of_hidden(outcome("spot_offset", one), one)
    # A level that is off leaves nothing to be explained.
    assert of_hidden(outcome("level_error", said()), said())


def test_counts_of_some_cases():
    taken = [said("unknown"), said("effect", ["core_law"]), said(), None]
    answers = [said("effect", ["gain_error"]), said("effect", ["gain_error", "core_law"]), said(), None]
    cases = [
        outcome("gain_error", a, without=w, seed=k)
        for k, (a, w) in enumerate(zip(answers, taken, strict=True))
    ]
    found = score("gain_error", cases)
    assert (found.cases, found.failed, found.right, found.too_many) == (4, 1, 2, 1)
    assert (found.taken_out, found.refused, found.misnamed) == (3, 1, 1)
    assert (found.chi2_after, found.held_out_before_percent, found.held_out_after_percent) == (1.1, 4.0, 0.9)


def test_law_errors_count_sizes():
    found = law_errors([BEFORE, AFTER])
    assert found.worst == 60.0
    assert found.median == pytest.approx((0.6 + 1.0) / 2)
    assert math.isnan(law_errors([]).median)


def test_the_law_s_errors_are_relative_at_three_frequencies():
    truth = draw("none", 1).truth.law
    law = FractionalZener(*truth.values)
    assert law_errors_percent(law, truth) == (pytest.approx((0, 0, 0)), pytest.approx((0, 0, 0)))
    softer = replace(law, g0_pa=0.9 * law.g0_pa, ginf_pa=0.9 * law.ginf_pa)
    storage, loss = law_errors_percent(softer, truth)
    assert storage == pytest.approx((-10, -10, -10))
    assert loss == pytest.approx((0, 0, 0), abs=1e-9)


def test_confusion_counts_first_answers_of_single_and_clean_cases():
    cases = [SPOT, GROUPED, outcome("none", said()), outcome("pair", said("effect", PAIR), PAIR)]
    cases += [outcome("level_error", said(channels=["level_error"])), outcome("gain_error", said("unknown"))]
    table = confusion(cases)
    assert list(table) == ["none", "spot_offset", "gain_error", "level_error"]
    assert table["gain_error"] == {"spot_offset": 1, "unknown": 1}
    assert table["level_error"] == {"level_error": 1}
    assert answer(said()) == "none"


def test_single_effects_are_scored_together_too():
    found = scores([SPOT, GROUPED, outcome("none", said("effect", ["core_law"]))])
    assert [s.name for s in found] == ["none", "spot_offset", "gain_error", "all single effects"]
    assert (found[0].right, found[-1].cases, found[-1].right, found[-1].in_group) == (0, 2, 1, 2)


def test_the_summary_lists_what_was_not_right():
    failed = replace(outcome("added_mass", None, seed=9), error="LinAlgError: singular")
    text = summary([SPOT, TOO_WIDE, failed])
    assert "| spot_offset | 1 | 1 | 1 | 0 |" in text
    assert "| gain_error | 1 | gain_error | 1e+03 | ambiguous | core_law | core_law, gain_error" in text
    assert "LinAlgError: singular" in text
    assert "nan" not in text
    assert "Not right" not in summary([SPOT])
    assert markdown(["a", "b"], [["1", "2"]]) == "| a | b |\n| --- | --- |\n| 1 | 2 |"


def test_an_outcome_survives_its_line():
    nan = replace(AFTER, chi2_per_dof=math.nan)
    one = outcome("gain_error", replace(GROUPED.said, after=nan), without=said("unknown"))
    back = outcome_of(json.loads(json.dumps(line_of(one), allow_nan=False)))
    assert math.isnan(back.said.after.chi2_per_dof)
    assert replace(back, said=None) == replace(one, said=None)
    assert replace(back.said, after=AFTER) == replace(one.said, after=AFTER)
