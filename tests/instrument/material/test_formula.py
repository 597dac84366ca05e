"""A law's formula comes back from what a result says of it."""

import numpy as np
import pytest
from conftest import TABLE_4

from instrument.material.formula import formula


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
