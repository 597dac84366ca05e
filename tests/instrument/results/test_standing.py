import numpy as np
import pytest
from diagnosis_cases import diagnosis

from fitting.diagnosis.verdict.kin import UNLISTED
from instrument.facts.diagnosis import DiagnosisResult
from instrument.results.diagnosis_figures import law_figure
from instrument.results.diagnosis_words import candidate_words, probability_words, verdict_line
from instrument.results.standing import (
    fit_words,
    is_one_of_several,
    law_words,
    laws_apart,
    none_is_likelier,
    one_fit_words,
    stage_before,
    stages_apart,
    standing,
)


def stand(found):
    return {c.name: standing(c.name, found) for c in found.candidates}


def weighed(*probabilities, **keys):
    """An ambiguous diagnosis, its candidates of these probabilities."""
    found = diagnosis(verdict="ambiguous", **keys)
    pairs = zip(found.candidates, probabilities, strict=True)
    return found.but(candidates=tuple(c.but(probability=p) for c, p in pairs))


def test_what_holds_95_percent_is_not_told_from_the_first_pairs_too():
    assert stand(weighed(0.6, 0.25, 0.149, 0.001)) == {
        "added_mass": "found",
        "spot_offset": "equal",
        "added_mass + spot_offset": "equal",
        "none": "none",
    }


def test_a_pair_beyond_95_percent_is_another():
    assert stand(weighed(0.66, 0.33, 0.01, 0.0))["added_mass + spot_offset"] == "other"


def test_what_is_not_told_apart_is_what_the_verdict_names_however_likely_it_is():
    """Of a shear pair no effect is likeliest, and a mass that its law imitates is not excluded."""
    found = weighed(0.034, 0.032, 0.001, 0.933).but(equivalent={"added_mass": ("added_mass", "none")})
    assert stand(found)["added_mass"] == "equal"
    assert stand(found)["spot_offset"] == "other"
    named = found.but(equivalent={"added_mass": ("added_mass", "spot_offset", "none")})
    unlikely = named.but(candidates=weighed(0.06, 0.001, 0.0, 0.939).candidates)
    assert stand(unlikely)["spot_offset"] == "equal"


def test_nothing_is_equal_to_what_is_certain():
    assert stand(diagnosis())["spot_offset"] == "other"


def test_by_hand_one_effect_stands_for_another_as_the_verdict_has_them():
    found = stand(weighed(np.nan, np.nan, np.nan, np.nan))
    assert (found["spot_offset"], found["added_mass + spot_offset"]) == ("equal", "other")


def not_excluded(none=0.97) -> DiagnosisResult:
    """No effect is likeliest, an added mass cannot be told from it; the law is that without."""
    found = weighed(1 - none, 0.0, 0.0, none)
    return found.but(equivalent={"added_mass": ("added_mass", "none")}, after=found.before)


def test_what_is_less_likely_than_no_effect_is_not_found_but_not_told_apart():
    found = not_excluded()
    assert none_is_likelier(found)
    assert stand(found)["added_mass"] != "found"
    assert stage_before(found) is None
    assert law_words(found) == "no effect, or added_mass"
    assert verdict_line(found).startswith(
        "verdict: ambiguous: no effect is likelier (97 %) than added_mass (mass"
    )


def test_what_is_likelier_than_no_effect_is_found():
    found = not_excluded(none=0.4)
    assert not none_is_likelier(found)
    assert stand(found)["added_mass"] == "found"
    assert stage_before(found) is found.before
    assert law_words(found) == "added_mass or no effect"
    assert "likelier" not in verdict_line(found)


@pytest.mark.parametrize(
    ("groups", "said"),
    [
        ({"a": ("a",)}, "a"),
        ({"a": ("a", "b")}, "a or b"),
        ({"a": ("a", UNLISTED)}, "a or another of its kind"),
        ({"a": ("a", "b", "c", "none")}, "a, no effect or 2 more"),
        ({"a": ("a", "b", "c", "d")}, "a or 3 others"),
        ({"a": ("a",), "b": ("b",)}, "a and b"),
        ({"a": ("a", "c"), "b": ("b",)}, "(a or c) and b"),
        ({}, ""),
    ],
)
def test_a_law_over_several_explanations_is_not_called_that_of_the_likeliest(groups, said):
    found = diagnosis().but(equivalent=groups)
    assert law_words(found) == said
    assert is_one_of_several(found) == ("or" in said)
    # What a fit leaves is of one explanation.
    assert fit_words(found) == " and ".join(groups)


def test_where_nothing_is_accepted_there_is_one_fit():
    found = diagnosis()
    assert stages_apart(found) == ("before", "after")
    alone = found.but(verdict="none", equivalent={})
    assert (stages_apart(alone), one_fit_words(alone)) == (("before",), "no effect is accepted")


def test_a_law_that_the_group_moves_is_not_the_one_before():
    found = not_excluded()
    moved = found.but(after=found.after.but(law=found.after.law[1:]))
    assert stage_before(moved) is moved.before


def doubted(*, verdict="ambiguous", kin=0.4):
    """An added mass, and something of its kind in no catalogue."""
    found = weighed(0.97 * (1 - kin), 0.02 * (1 - kin), 0.005 * (1 - kin), 0.005 * (1 - kin))
    unlisted = found.candidates[0].but(name=UNLISTED, probability=kin, parameters={}, checks={})
    group = {"added_mass": ("added_mass", UNLISTED)} if verdict == "ambiguous" else {}
    return found.but(verdict=verdict, candidates=(*found.candidates, unlisted), equivalent=group)


def test_what_is_in_no_catalogue_is_not_told_from_what_is_named_and_takes_no_ones_place():
    found = doubted()
    said = stand(found)
    assert (said["added_mass"], said[UNLISTED], said["spot_offset"]) == ("found", "equal", "other")
    assert "cannot tell added_mass from something of its kind in no catalogue (40 %)" in verdict_line(found)


def test_where_nothing_explains_what_is_in_no_catalogue_is_not_what_is_refused():
    found = doubted(verdict="unknown", kin=0.99)
    assert stand(found)[UNLISTED] == "other"
    words = {c.name: probability_words(c, found) for c in found.candidates}
    assert words[UNLISTED] == "99.0 %"
    assert words["added_mass"] != words[UNLISTED]


def test_the_one_law_that_is_shown_is_the_one_that_stands():
    found = diagnosis().but(verdict="unknown", equivalent={})
    assert laws_apart(found) == ("after",)
    assert laws_apart(diagnosis()) == ("before", "after")
    wider = found.but(
        after=found.after.but(
            law=tuple(r.but(storage_modulus_standard_error_pa=1e5) for r in found.after.law)
        )
    )
    ax, _ = law_figure(wider).axes
    (band,) = ax.collections
    assert np.ptp(band.get_paths()[0].vertices[:, 1]) > 2 * 1.9 * 0.1


def test_in_a_table_what_is_no_effect_says_what_it_is():
    assert candidate_words("added_mass") == "added_mass"
    assert candidate_words(UNLISTED) == "unlisted: like these, in no catalogue"
