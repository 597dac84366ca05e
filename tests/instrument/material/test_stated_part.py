"""What stated numbers make of a law's error is told from the fit's own covariance."""

import numpy as np
import pytest
from found_law_cases import ERRORS, facts, said_of_curve
from paper_law import TABLE_4

from instrument.material.stated_part import digest_of, stated_columns, stated_numbers, stays_with_the_specimen

YOUNG = {"name": "substrate_young", "stated": 70.0, "tolerance": 1.0, "found": 70.5}


def with_a_stated_number(passed):
    """A fit in which a tolerance of `substrate_young` gives the laws' logarithms `passed` each."""
    C = np.block([[np.diag(ERRORS**2) + np.outer(passed, passed), passed[:, None]], [passed, np.ones(1)]])
    known = said_of_curve(TABLE_4, C, [YOUNG["name"]])
    return {**facts(TABLE_4), "adjusted": [YOUNG], "law_known": known}


def test_a_number_that_makes_the_whole_modulus_larger_is_the_whole_of_that_part():
    found = stated_columns(with_a_stated_number(np.array([0.02, 0.02, 0.0, 0.0])))
    assert found["storage"] == pytest.approx([0.02] * 41)
    assert found["loss"] == pytest.approx([0.0] * 41, abs=1e-12)


def test_a_fit_that_does_not_say_how_its_errors_are_made_up_has_no_such_part():
    found = stated_columns({**facts(TABLE_4, posterior=False), "adjusted": [YOUNG]})
    assert found["same"] is not None
    assert found["storage"] is None
    assert stated_columns(facts(TABLE_4))["same"] is None


def test_specimens_that_state_the_same_are_known_by_one_digest():
    def digest(*rows):
        return digest_of(stated_numbers({"adjusted": list(rows)}))

    other = {**YOUNG, "name": "core_thickness"}
    assert digest(YOUNG, other) == digest(other, {**YOUNG, "found": 69.0})
    assert digest(YOUNG) != digest({**YOUNG, "stated": 71.0})
    assert digest() is None


def test_what_a_mounting_sets_anew_does_not_stay_with_the_specimen():
    stay = ("core_thickness", "substrate_young [2, 3]", "patch_1_x0", "held_width")
    assert [name for name in stay if not stays_with_the_specimen(name)] == []
    anew = ("length", "length [2]", "pickup_x", "damping_3", "gain [1]", "place_1_y", "no such number")
    assert [name for name in anew if stays_with_the_specimen(name)] == []
