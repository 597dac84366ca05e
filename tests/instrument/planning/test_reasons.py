"""Why a measurement tells explanations apart: only what is said of those in question."""

from typing import get_args

import pytest

from fitting.effects import CATALOGUE
from instrument.facts.follow_up import FollowUpKind
from instrument.planning.reasons import why


@pytest.mark.parametrize("kind", get_args(FollowUpKind))
def test_there_is_a_sentence_for_every_effect_and_for_none(kind):
    for name in ("none", *CATALOGUE, "made_by_a_plugin"):
        said = why(kind, (name, "none"))
        assert said[0].isupper()
        assert said.endswith(".")


def test_a_reason_speaks_of_the_explanations_in_question_alone():
    of_clamps = why("spot", ("clamp_compliance", "uneven_clamp"))
    assert "clamp" in of_clamps
    assert "across its width" in of_clamps
    assert "channel" not in of_clamps
    assert "offset" not in of_clamps
    assert "channel" in why("spot", ("gain_error", "none"))


def test_both_of_a_pair_are_spoken_of_and_nothing_twice():
    said = why("clamping", ("clamp_compliance + gain_error", "clamp_friction"))
    assert said == "Clamped anew the clamp is another one; the channel stays as it is."


def test_where_nothing_is_known_it_does_not_say_more_than_that_they_differ():
    assert why("spot", ("temperature_drift", "none")) == "The explanations expect other readings there."
