"""What stated numbers make of a law's error is told from the fit's own covariance."""

import numpy as np
import pytest
from conftest import TABLE_4
from found_law_cases import ERRORS, NAMES, facts

from instrument.material.stated_part import stated_columns, stated_numbers

YOUNG = {"name": "substrate_young", "stated": 70.0, "tolerance": 1.0, "found": 70.5}


def with_a_stated_number(passed):
    """A fit in which a tolerance of `substrate_young` gives the laws' logarithms `passed` each."""
    found = facts(TABLE_4)
    C = np.block([[np.diag(ERRORS**2) + np.outer(passed, passed), passed[:, None]], [passed, np.ones(1)]])
    rows = [C[k, : k + 1].tolist() for k in range(len(C))]
    return {**found, "adjusted": [YOUNG], "posterior": {"names": [*NAMES, YOUNG["name"]], "rows": rows}}


def test_a_number_that_makes_the_whole_modulus_larger_is_the_whole_of_that_part():
    found = stated_columns(with_a_stated_number(np.array([0.02, 0.02, 0.0, 0.0])))
    assert found["storage"] == pytest.approx([0.02] * 41)
    assert found["loss"] == pytest.approx([0.0] * 41, abs=1e-12)


def test_a_fit_that_does_not_say_how_its_errors_are_made_up_has_no_such_part():
    found = stated_columns({**facts(TABLE_4), "adjusted": [YOUNG]})
    assert found["same"] is not None
    assert found["storage"] is None
    assert stated_columns(facts(TABLE_4))["same"] is None


def test_specimens_that_state_the_same_are_known_by_one_digest():
    other = {**YOUNG, "name": "core_thickness"}
    assert stated_numbers({"adjusted": [YOUNG, other]}) == stated_numbers(
        {"adjusted": [other, {**YOUNG, "found": 69.0}]}
    )
    assert stated_numbers({"adjusted": [YOUNG]}) != stated_numbers({"adjusted": [{**YOUNG, "stated": 71.0}]})
    assert stated_numbers({"adjusted": []}) is None
