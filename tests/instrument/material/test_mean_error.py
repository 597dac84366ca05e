"""The error of a mean holds what it says, with few laws and with stated numbers that all of them share."""

import numpy as np
import pytest

from fitting.numerics.chances import Z_95
from instrument.material.mean_error import mean_error


def coverage(count, spread, noise, stated, *, shared, seed=1, tries=1500):
    """How often 1.96 errors hold the true mean; a stated number is off for all laws alike, or for each."""
    rng = np.random.default_rng(seed)
    error = np.full(count, np.hypot(noise, stated))
    inside = []
    for _ in range(tries):
        off = stated * rng.standard_normal(1 if shared else count)
        y = spread * rng.standard_normal(count) + noise * rng.standard_normal(count) + off
        same = ["one"] * count if shared else [str(k) for k in range(count)]
        found = mean_error(y, error, np.full(count, stated), same, spread)
        inside.append(abs(np.mean(y)) < Z_95 * found)
    return np.mean(inside)


@pytest.mark.parametrize("count", [3, 6, 12])
@pytest.mark.parametrize("spread", [0.0, 0.04])
def test_ninety_five_of_a_hundred_hold_with_shared_numbers(count, spread):
    assert coverage(count, spread, 0.005, 0.03, shared=True) > 0.93


@pytest.mark.parametrize("count", [3, 6, 12])
def test_ninety_five_of_a_hundred_hold_where_each_has_its_own(count):
    assert coverage(count, 0.04, 0.01, 0.02, shared=False) == pytest.approx(0.955, abs=0.02)


def test_numbers_of_its_own_are_no_more_than_errors():
    y, error = np.array([0.0, 0.01, -0.01, 0.02]), np.full(4, 0.02)
    own = mean_error(y, error, error, [None] * 4, 0.0)
    assert own == mean_error(y, error, np.zeros(4), ["a"] * 4, 0.0)
    assert mean_error(y, error, error, ["a"] * 4, 0.0) > 0.02 > own


def test_laws_that_happen_to_agree_are_known_no_better_than_their_noise_allows():
    error = np.full(4, 0.02)
    assert mean_error(np.zeros(4), error, np.zeros(4), [None] * 4, 0.0) == pytest.approx(0.01)
