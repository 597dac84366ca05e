import numpy as np
from diagnosis_cases import diagnosis

from instrument.results.standing import standing


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


def test_what_is_beyond_95_percent_is_another():
    assert stand(weighed(0.96, 0.03, 0.01, 0.0))["spot_offset"] == "other"


def test_nothing_is_equal_to_what_is_certain():
    assert stand(diagnosis())["spot_offset"] == "other"


def test_by_hand_one_effect_stands_for_another_as_the_verdict_has_them():
    found = stand(weighed(np.nan, np.nan, np.nan, np.nan))
    assert (found["spot_offset"], found["added_mass + spot_offset"]) == ("equal", "other")
