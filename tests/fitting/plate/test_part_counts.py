"""Slices of arrays that hold the parts of all matrices one after another."""

import numpy as np
import pytest

from fitting.plate.part_counts import PartCounts

COUNTS = PartCounts(2, 1, 3)
C = np.array([2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0])
"""Coefficients of six parts, and of one of the load."""


def test_parts_of_all_matrices_and_of_the_load_follow_each_other():
    found = [C[at].tolist() for at in (COUNTS.K_0, COUNTS.K_1, COUNTS.M, COUNTS.load)]
    assert found == [[2, 3], [5], [7, 11, 13], [17]]
    assert C[COUNTS.matrices].tolist() == C[:6].tolist()
    assert COUNTS.each == (2, 1, 3)


def test_each_matrix_is_the_sum_of_its_own_parts():
    parts = np.arange(24.0).reshape(6, 2, 2)
    found = COUNTS.summed(C, parts)
    by_hand = [2 * parts[0] + 3 * parts[1], 5 * parts[2], 7 * parts[3] + 11 * parts[4] + 13 * parts[5]]
    for one, expected in zip(found, by_hand, strict=True):
        np.testing.assert_array_equal(one, expected)


@pytest.mark.parametrize("counts", [PartCounts(), PartCounts(2, 0, 1)])
def test_a_matrix_without_parts_has_none(counts):
    assert C[counts.K_1].size == 0


def test_of_the_dynamic_stiffness_the_modulus_weighs_the_core_and_frequency_the_mass():
    each = np.ones((6, 2), complex)
    COUNTS.weigh(each, np.array([1j, 2j]), np.array([-4.0, -9.0]))
    assert each[:, 0].tolist() == [1, 1, 1j, -4, -4, -4]
    assert each[:, 1].tolist() == [1, 1, 2j, -9, -9, -9]
