"""Stated numbers moved together, by what a linear theory says of them."""

import numpy as np
from scipy.stats import kstest

from fitting.identification.as_stated import is_unlikely, pulled_together

J = np.array([[1.0, 1.0, 0.0, 0.2], [0.0, 0.5, 0.3, 0.1], [0.4, 0.0, 0.1, 0.0]])
"""Of three data by four stated numbers; noise is 1."""


def fitted(y):
    """Mean and covariance of the numbers, prior N(0, I)."""
    C = np.linalg.inv(np.eye(4) + J.T @ J)
    return C @ J.T @ y, C


def test_of_numbers_that_are_stated_rightly_it_is_a_chi_square():
    rng = np.random.default_rng(1)
    drawn = [pulled_together(*fitted(J @ rng.normal(size=4) + rng.normal(size=3))) for _ in range(2000)]
    directions = {n for _, n in drawn}
    assert directions == {3}
    assert kstest([x for x, _ in drawn], "chi2", args=(3,)).pvalue > 0.01


def test_one_that_is_far_off_is_seen_though_none_is_moved_by_much():
    weak = np.array([0.3, 0.3, 0.3, 0.3])[None]
    C = np.linalg.inv(np.eye(4) + weak.T @ weak)
    z = C @ weak.T @ (weak @ np.array([0.0, 0.0, 0.0, 40.0]))
    assert np.max(np.abs(z)) < 3
    assert is_unlikely(*pulled_together(z, C))
    assert not is_unlikely(*pulled_together(z / 10, C))


def test_where_data_say_nothing_of_them_nothing_is_said():
    assert pulled_together(np.zeros(4), np.eye(4)) == (0.0, 0)
    assert not is_unlikely(0.0, 0)
