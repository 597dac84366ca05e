"""How far apart rivals predict data, against formulas of the normal distribution."""

import numpy as np
import pytest
from scipy.stats import norm

from fitting.planning.rivalry import Forecast, outcome, share_left

EVEN = np.array([0.5, 0.5])


def sharp(*mean):
    """A rival that knows what it expects."""
    return Forecast(np.array(mean, float), np.zeros((len(mean), 1)))


def test_two_sharp_rivals_are_half_their_squared_distance_apart():
    found = outcome([sharp(0, 0), sharp(3, 4)], EVEN)
    assert found.between(0, 1) == pytest.approx(12.5)
    assert np.diag(found.divergence) == pytest.approx([0, 0], abs=1e-12)


def test_a_divergence_of_spreads_is_kullbacks():
    narrow, wide = sharp(0), Forecast(np.zeros(1), np.array([[3.0]]))
    found = outcome([narrow, wide], EVEN)
    # N(0, 1) against N(0, 10).
    assert found.divergence[0, 1] == pytest.approx((0.1 - 1 + np.log(10)) / 2)
    assert found.divergence[1, 0] == pytest.approx((10 - 1 - np.log(10)) / 2)


def test_what_no_rival_knows_separates_none():
    # Both expect another mean, and neither knows the gain that would move one to the other.
    gain = np.array([[1e3], [0.0]])
    found = outcome([Forecast(np.array([0.0, 0.0]), gain), Forecast(np.array([5.0, 0.0]), gain)], EVEN)
    assert found.between(0, 1) < 1e-4
    assert found.information < 0.01
    assert found.resolved == 0


def test_the_chance_to_resolve_is_that_of_the_normal_distribution():
    d = 3.0
    found = outcome([sharp(0), sharp(d)], EVEN)
    # ln odds of the true one are normal about d^2/2 with standard deviation d; 95 % are odds of 19.
    wanted = norm.sf((np.log(19) - d**2 / 2) / d) + norm.cdf((-np.log(19) - d**2 / 2) / d)
    assert found.resolved == pytest.approx(wanted, abs=0.06)


def test_information_never_exceeds_what_is_unknown():
    p = np.array([0.7, 0.3])
    found = outcome([sharp(0), sharp(40)], p)
    assert found.information == pytest.approx(-np.sum(p * np.log(p)), abs=1e-6)
    assert found.resolved == pytest.approx(1.0)


def test_a_rival_is_as_far_away_as_its_nearest_form():
    three = [sharp(0), sharp(6), sharp(1)]
    found = outcome(three, np.array([0.5, 0.25, 0.25]), of=[0, 1, 1])
    # The far form is 18 off, the near one 0.5: half of the time each is the true one.
    assert found.divergence[0, 1] == pytest.approx(0.5)
    assert found.divergence[1, 0] == pytest.approx((18 + 0.5) / 2)
    assert found.divergence.shape == (2, 2)


def test_forms_of_one_rival_need_not_be_told_apart():
    p = np.array([0.5, 0.25, 0.25])
    alike, other = (outcome([sharp(0), sharp(a), sharp(b)], p, of=[0, 1, 1]) for a, b in ((9, 18), (0, 18)))
    assert alike.resolved == pytest.approx(1.0)
    assert alike.information == pytest.approx(np.log(2), abs=1e-3)
    assert other.resolved < 0.5


def test_tempering_is_worth_fewer_data():
    plain = outcome([sharp(0), sharp(3)], EVEN)
    tempered = outcome([sharp(0), sharp(3)], EVEN, temper=4.0)
    assert tempered.information < plain.information
    assert tempered.between(0, 1) == pytest.approx(plain.between(0, 1) / 4)


def test_the_same_data_give_the_same_chances():
    one, again = (outcome([sharp(0), sharp(2)], EVEN) for _ in range(2))
    assert (one.information, one.resolved) == (again.information, again.resolved)


def test_two_measurements_share_what_is_the_same_in_both_and_nothing_else():
    a = Forecast(np.array([1.0]), np.array([[2.0, 5.0]]), known=1)
    b = Forecast(np.array([3.0, 4.0]), np.array([[7.0, 1.0, 0.0], [8.0, 0.0, 1.0]]), known=1)
    both = a.then(b)
    assert both.mean.tolist() == [1.0, 3.0, 4.0]
    assert both.root @ both.root.T == pytest.approx(
        np.array([[29.0, 14.0, 16.0], [14.0, 50.0, 56.0], [16.0, 56.0, 65.0]])
    )


def test_what_is_left_alone_is_that_of_the_outcome():
    rivals = [sharp(0), sharp(3), sharp(1)]
    p = np.array([0.5, 0.3, 0.2])
    whole = outcome(rivals, p, of=[0, 1, 1])
    assert share_left(rivals, p, of=[0, 1, 1]) == whole.left
    assert whole.information == pytest.approx((1 - whole.left) * np.log(2))


def test_some_of_the_data_are_expected_as_among_all():
    whole = Forecast(np.arange(3.0), np.arange(6.0).reshape(3, 2), known=1)
    some = whole.of(np.array([2, 0]))
    assert some.mean.tolist() == [2.0, 0.0]
    assert some.root.tolist() == [[4.0, 5.0], [0.0, 1.0]]
    assert some.known == 1


def test_divergences_are_those_of_the_covariances_in_full():
    dice = np.random.default_rng(4)
    a, b = (Forecast(dice.standard_normal(7), 3 * dice.standard_normal((7, 4))) for _ in range(2))
    S, T = (np.eye(7) + f.root @ f.root.T for f in (a, b))
    off = a.mean - b.mean
    inverse = np.linalg.inv(T)
    wanted = (
        np.trace(inverse @ S) - 7 + off @ inverse @ off + np.linalg.slogdet(T)[1] - np.linalg.slogdet(S)[1]
    )
    assert outcome([a, b], EVEN).divergence[0, 1] == pytest.approx(wanted / 2, rel=1e-9)
