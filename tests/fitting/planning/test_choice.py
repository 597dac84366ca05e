"""Steps chosen one by one, against what can be said without a computer."""

import numpy as np
import pytest
from planning_cases import LAW, aims, sensitivity

from fitting.planning.aims import Aims
from fitting.planning.choice import choose, gains, limit_of, with_reading


def test_aims_are_relative_errors_of_modulus_and_loss_factor():
    found = Aims.over(LAW, 10.0, 100.0, 2)
    C = np.diag([0.01**2, 0.03**2])
    np.testing.assert_allclose(found.errors(C), [[0.01, 0.01], [0.03, 0.03]])


def test_the_best_reading_for_its_time_is_taken_first():
    s = sensitivity([10.0, 30.0, 29.0])
    assert choose(s, aims(), np.array([1.0, 1.0, 1.0]), 0.031, most=1).taken[0] == 1
    assert choose(s, aims(), np.array([1.0, 3.0, 1.0]), 0.031, most=1).taken[0] == 2


def test_steps_end_where_the_target_is_met():
    s = sensitivity(np.full(20, 50.0))
    # So many readings of 2 % leave 2 % / sqrt(n).
    found = choose(s, aims(), np.ones(20), 0.01)
    assert found.reached
    assert len(found.taken) == 4
    np.testing.assert_allclose(found.worst[1:], 0.02 / np.sqrt([1, 2, 3, 4]), rtol=1e-6)
    assert found.seconds[-1] == 4


def test_no_candidate_is_taken_twice():
    s = sensitivity(np.full(5, 10.0))
    found = choose(s, aims(), np.ones(5), 1e-3)
    assert len(set(found.taken)) == len(found.taken) <= 5
    assert not found.reached


def test_a_target_out_of_reach_is_said_and_not_chased():
    s = sensitivity(np.full(400, 10.0), others=2)
    found = choose(s, aims(), np.ones(400), 1e-3)
    assert not found.reachable
    assert found.limit == pytest.approx(limit_of(s, aims()))
    assert found.worst[-1] <= 1.1 * found.limit
    assert len(found.taken) < 390


def test_a_time_budget_is_kept():
    s = sensitivity(np.full(20, 10.0))
    found = choose(s, aims(), np.full(20, 2.0), 1e-3, budget_s=9.0)
    assert len(found.taken) == 4
    assert found.seconds[-1] == 8.0


def test_readings_there_are_count():
    s = sensitivity(np.full(20, 50.0))
    taken = np.zeros(20)
    taken[:3] = 1
    assert len(choose(s, aims(), np.ones(20), 0.01, taken=taken).taken) == 1


def test_one_reading_more_is_the_inverse_of_the_sum():
    s = sensitivity([3.0, 5.0, 7.0], others=3)
    before, after = s.covariance(np.array([1, 0, 0])), s.covariance(np.array([1, 0, 1]))
    np.testing.assert_allclose(with_reading(before, s.rows[2]), after, rtol=1e-9, atol=1e-15)


def test_a_gain_is_what_the_criterion_really_loses():
    s = sensitivity([3.0, 5.0, 7.0], others=3)
    C, goal = s.covariance(np.array([1, 0, 0])), 0.1
    found = gains(s, aims(), C, goal)

    def criterion(covariance):
        return np.sum((aims().errors(covariance) / goal) ** 8)

    for k in range(3):
        left = criterion(with_reading(C, s.rows[k])) / criterion(C)
        assert found[k] == pytest.approx(-np.log(left), rel=1e-9)
