import numpy as np
import pytest
from scipy.optimize import OptimizeResult, least_squares

from fitting.diagnosis.inference.pace import Steps, is_within_reach


def valley(x):
    """Two numbers that are found along a winding floor (Rosenbrock)."""
    return np.array([10 * (x[1] - x[0] ** 2), 1 - x[0]])


def followed(goal):
    steps = Steps(goal)
    return least_squares(valley, [-1.2, 1.0], callback=steps), steps


def test_a_fit_that_may_come_to_its_goal_is_left_alone():
    alone = least_squares(valley, [-1.2, 1.0])
    found, _ = followed(1e-6)
    np.testing.assert_array_equal(found.x, alone.x)
    assert found.status == alone.status


def test_a_fit_ends_where_its_goal_is_out_of_reach():
    found, steps = followed(-1e4)
    assert found.status == -2
    assert found.nfev < least_squares(valley, [-1.2, 1.0]).nfev
    assert not is_within_reach(2 * found.cost, -1e4, steps.pace)


def test_a_fit_is_at_rest_where_too_little_is_left_to_gain_in_all_its_steps():
    alone = least_squares(valley, [-1.2, 1.0])
    steps = Steps(least=50.0)
    found = least_squares(valley, [-1.2, 1.0], callback=steps)
    assert steps.converged
    assert found.status == -2
    assert found.nfev < alone.nfev
    assert not followed(1e-6)[1].converged


def test_a_pace_is_the_better_one_of_the_last_two_steps_and_not_known_before():
    steps = Steps()
    for chi2 in (900.0, 100.0):
        steps(at(chi2))
        assert steps.pace == np.inf
    steps(at(98.0))
    assert steps.pace == pytest.approx(800.0)
    steps(at(98.0))
    assert steps.pace == pytest.approx(2.0)
    steps(at(98.0))
    assert steps.pace == 0.0


def test_a_rough_fit_ends_where_no_step_it_has_left_could_make_it_the_best():
    alone = least_squares(valley, [-1.2, 1.0], max_nfev=10)
    well_behind = Steps(rival=-1e3, most=10)
    found = least_squares(valley, [-1.2, 1.0], max_nfev=10, callback=well_behind)
    assert found.status == -2
    assert found.nfev < alone.nfev
    near_by = Steps(rival=2 * alone.cost - 1e-3, most=10)
    again = least_squares(valley, [-1.2, 1.0], max_nfev=10, callback=near_by)
    np.testing.assert_array_equal(again.x, alone.x)


def at(chi2):
    return OptimizeResult(cost=chi2 / 2)
