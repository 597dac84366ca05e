"""A law's formula comes back from what a result says of it."""

import numpy as np
import pytest
from paper_law import TABLE_4

from instrument.material.formula import formula, limits


def test_a_law_is_what_its_parameters_say():
    again = formula(TABLE_4.kind, dict(zip(TABLE_4.names, TABLE_4.values, strict=True)))
    omega = 2 * np.pi * np.geomspace(10, 1000, 7)
    np.testing.assert_array_equal(again.modulus(omega), TABLE_4.modulus(omega))


def test_lists_come_back_in_their_order():
    names = ("g_inf_pa", "g_2_pa", "g_1_pa", "tau_1_s", "tau_2_s")
    law = formula("generalised-maxwell", dict(zip(names, (1e5, 3e5, 2e5, 1e-3, 1e-4), strict=True)))
    assert law.g_pa == (2e5, 3e5)
    assert law.tau_s == (1e-3, 1e-4)


def test_a_parameter_that_is_missing_is_said():
    with pytest.raises(KeyError):
        formula(TABLE_4.kind, {})


def test_limits_are_those_of_each_parameter_and_of_a_list_s_items():
    found = limits("generalised-maxwell", {"g_inf_pa": 1e5, "g_1_pa": 2e5, "tau_1_s": 1e-3, "other": 1.0})
    assert set(found) == {"g_inf_pa", "g_1_pa", "tau_1_s"}
    assert found["g_1_pa"].lower == 1e1
    assert limits("of-another-package", {"g_pa": 1.0}) == {}
