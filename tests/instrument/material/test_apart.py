"""A specimen that is not like the others is named; honest groups of any size hardly ever name one."""

import numpy as np
import pytest

from instrument.material.apart import LEVEL_APART, means_of_others, p_values

COLUMNS = 14
"""Seven frequencies of G' and of eta."""


def group(rng, count, spread, known):
    """Curves off by a level and a slope of their own, G' and eta each; columns go together as a law's do."""
    at = np.linspace(-1, 1, COLUMNS // 2)
    curves = [
        np.concatenate([rng.standard_normal() + 0.5 * at * rng.standard_normal() for _ in range(2)])
        for _ in range(count)
    ]
    errors = known * rng.uniform(0.7, 1.4, (count, 1)) * np.ones(COLUMNS)
    return np.hypot(spread, errors) * np.array(curves) / np.hypot(1, 0.5 * np.concatenate([at, at])), errors


def false_alarms(spread, known, groups, seed):
    rng = np.random.default_rng(seed)
    found = [p_values(*group(rng, int(rng.integers(4, 13)), spread, known)) for _ in range(groups)]
    return np.mean([np.min(p) < LEVEL_APART for p in found])


@pytest.mark.parametrize("spread", [0.0, 0.02, 0.05, 0.1])
def test_honest_groups_name_none_but_by_chance(spread):
    assert false_alarms(spread, 0.02, 150, 1) <= 0.06


@pytest.mark.long
@pytest.mark.parametrize(
    ("spread", "most"), [(0.0, 0.025), (0.01, 0.03), (0.02, 0.03), (0.04, 0.05), (0.08, 0.06), (0.16, 0.08)]
)
@pytest.mark.parametrize("known", [0.003, 0.03])
def test_honest_groups_name_none_but_by_chance_over_many(spread, most, known):
    assert false_alarms(spread, known, 1000, 2) <= most


@pytest.mark.parametrize("count", [4, 6, 12])
def test_a_third_more_stiffness_is_named(count):
    rng = np.random.default_rng(3)
    named = []
    for _ in range(30):
        curves, errors = group(rng, count, 0.02, 0.02)
        curves[1, : COLUMNS // 2] += np.log(1.4)
        p = p_values(curves, errors)
        named.append(p[1] < LEVEL_APART)
        assert np.sum(p < LEVEL_APART) <= 1
    assert np.mean(named) > 0.75


def test_of_three_laws_no_group_is_told_apart():
    assert np.isnan(p_values(*group(np.random.default_rng(0), 3, 0.0, 0.02))).all()


def test_the_mean_of_the_others_leaves_one_out():
    curves, errors = group(np.random.default_rng(4), 5, 0.03, 0.02)
    spread = np.full(COLUMNS, 0.03)
    w = 1 / (errors**2 + spread**2)
    left = np.arange(5) != 2
    expected = np.average(curves[left], axis=0, weights=w[left])
    assert means_of_others(curves, errors, spread)[2] == pytest.approx(expected)
