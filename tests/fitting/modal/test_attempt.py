"""A fit that breaks down is a refusal with its reason, not an error and not a warning."""

import numpy as np
import pytest

from fitting.modal.attempt import refusing
from fitting.modal.frf import Refusal


def test_a_fit_that_works_is_passed_on():
    assert refusing(lambda a, b: a + b)(1, b=2) == 3


def test_a_singular_matrix_is_a_refusal_that_says_so():
    found = refusing(lambda: np.linalg.solve(np.zeros((2, 2)), np.ones(2)))()
    assert isinstance(found, Refusal)
    assert "Singular matrix" in found.why


def test_numbers_beyond_floats_break_a_fit_without_a_warning():
    assert np.isnan(refusing(lambda x: x * np.inf * 0)(np.float64(1.0)))
    assert isinstance(refusing(lambda: 1 / 0)(), Refusal)


def test_a_mistake_in_the_program_is_no_refusal():
    with pytest.raises(TypeError):
        refusing(lambda: None + 1)()
