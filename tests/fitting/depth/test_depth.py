"""Profile and posterior of one sweep: against the linear errors and the response in full."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from scipy.optimize import least_squares
from threadpoolctl import threadpool_limits

from fitting.depth.bootstrap import refitted
from fitting.depth.chains import r_hat
from fitting.depth.intervals import Intervals
from fitting.depth.many import ManyResiduals
from fitting.depth.marginal import MarginalLaw
from fitting.depth.posterior import sample
from fitting.depth.profile import profile
from fitting.depth.quantities import Quantities
from fitting.depth.sweep_task import SweepTask
from instrument.files.sweep_file import read_sweep
from instrument.finding.identification import identify
from instrument.models.files import File

AT = np.array([20.0, 100.0, 280.0])


@pytest.fixture(scope="module")
def found(coarse, mesh_is_right):
    whole = read_sweep(DATA / "practice-002.csv").sweep(coarse.base_acceleration_m_s2)
    sweep = whole.take(np.arange(len(whole)) % 6 == 0)
    with threadpool_limits(1, "blas"):
        return identify([File(sweep, replace(coarse, exact=False))])


@pytest.fixture(scope="module")
def quantities(found):
    return Quantities.of(SweepTask.begun_with(found.joint.begun), AT)


@pytest.fixture(scope="module")
def many(found, quantities):
    return ManyResiduals(quantities.task, found.joint.reduced)


def test_gradients_are_those_of_the_quantities(quantities):
    x, h = quantities.task.mode, 1e-6
    slopes = quantities.gradient(x)
    for k in range(len(x)):
        up, down = x.copy(), x.copy()
        up[k], down[k] = x[k] + h, x[k] - h
        numeric = (quantities.logs(up) - quantities.logs(down)) / (2 * h)
        np.testing.assert_allclose(slopes[:, k], numeric, atol=1e-6)


def test_many_residuals_are_those_in_full_near_the_fit(quantities, many):
    task = quantities.task
    rng = np.random.default_rng(3)
    X = task.mode + 0.3 * rng.standard_normal((8, task.root.shape[1])) @ task.root.T
    at = task.residuals(task.mode)
    full = np.array([task.residuals(x) for x in X])
    off = np.linalg.norm(many(X) - full, axis=1) / np.linalg.norm(full - at, axis=1)
    assert np.median(off) < 0.15


def test_chains_have_seen_enough_and_the_profile_is_near_the_linear_errors(quantities, many):
    with threadpool_limits(1, "blas"):
        by_profile = profile(quantities)
        drawn = sample(quantities, many, 8_000)
    assert drawn.r_hat.max() < 1.1
    assert drawn.effective.min() > 400
    assert drawn.weight_share > 0.3
    assert np.all(np.abs(by_profile.off()[-6:]) < 0.35), by_profile.advice


def test_a_posterior_of_one_seed_is_the_same_again(quantities, many):
    first, again = (sample(quantities, many, 2_000, seed=5) for _ in range(2))
    np.testing.assert_array_equal(first.intervals.bounds[68], again.intervals.bounds[68])


def test_where_the_law_is_all_that_is_not_known_the_posterior_is_of_the_law(coarse):
    whole = read_sweep(DATA / "practice-002.csv").sweep(coarse.base_acceleration_m_s2)
    exact = identify([File(whole.take(np.arange(len(whole)) % 6 == 0), replace(coarse, exact=True))])
    alone = Quantities.of(SweepTask.begun_with(exact.joint.begun), AT)
    drawn = sample(alone, ManyResiduals(alone.task, exact.joint.reduced), 2_000)
    # The short cut is all but exact there: what is evaluated in full weighs as it was drawn.
    assert drawn.checked == 60
    assert drawn.weight_share > 0.95
    assert drawn.log_error < 0.2
    linear, wide = (
        np.diff(np.log(b[68][-6:]), axis=1) for b in (drawn.intervals.linear, drawn.intervals.bounds)
    )
    np.testing.assert_allclose(wide, linear, rtol=0.4)


def test_what_is_known_well_has_a_profile_as_wide_as_its_linear_error(quantities):
    k = quantities.names.index("storage_modulus_pa at 100 Hz")
    one = profile(quantities, only=[k])
    for level in (68, 95):
        wide, linear = (np.diff(np.log(b[level][k]))[0] for b in (one.bounds, one.linear))
        assert wide == pytest.approx(linear, rel=0.2)
    assert np.isnan(np.delete(one.bounds[68], k, axis=0)).all()


def test_chains_that_disagree_are_seen():
    rng = np.random.default_rng(0)
    alike = rng.standard_normal((8, 200))
    assert r_hat(alike) < 1.02
    assert r_hat(alike + np.arange(8)[:, None]) > 1.5


def test_advice_names_what_differs():
    linear = {68: np.array([[0.9, 1.1], [1.9, 2.1]]), 95: np.array([[0.8, 1.2], [1.8, 2.2]])}
    own = {68: np.array([[0.9, 1.1], [1.9, 2.3]]), 95: linear[95]}
    one = Intervals("profile", ("a", "b"), np.array([1.0, 2.0]), linear, own)
    assert one.advice == "take the interval by profile, not the linear error, for b (upper +200 %)"
    same = replace(one, bounds=linear)
    assert "agree within 20 %" in same.advice


def test_jacobians_of_many_are_those_of_their_residuals(quantities, many):
    task, h = quantities.task, 1e-5
    rng = np.random.default_rng(5)
    X = np.clip(task.mode + 0.5 * rng.standard_normal((2, task.root.shape[1])) @ task.root.T, *task.limits)
    for x, J in zip(X, many.jacobians(X), strict=True):
        steps = h * np.eye(len(x))
        numeric = (many(x + steps) - many(x - steps)).T / (2 * h)
        size = np.linalg.norm(numeric, axis=0)
        np.testing.assert_allclose(J / size, numeric / size, atol=1e-4)


def test_every_refit_of_a_bootstrap_comes_to_rest(quantities, many):
    """Against bounded least squares of one draw after the other; some lie far off."""
    task = quantities.task
    at = many(task.mode[None])[0]
    shift = 2 * np.random.default_rng(6).standard_normal((4, len(at))) - at
    for x, own in zip(refitted(many, shift), shift, strict=True):
        alone = least_squares(
            lambda p, own=own: many(p[None])[0] + own,
            task.mode,
            jac=lambda p: many.jacobians(p[None])[0],
            bounds=task.limits,
            x_scale="jac",
        )
        assert np.sum((many(x[None])[0] + own) ** 2) < 2 * alone.cost + 0.05


@pytest.fixture(scope="module")
def marginal(many):
    return MarginalLaw(many)


def near(marginal, count, seed=7):
    """Parameters of the law drawn as wide as the linear errors say."""
    task, own = marginal.task, marginal.own
    xi = np.random.default_rng(seed).standard_normal((count, task.root.shape[1]))
    return (task.mode + xi @ task.root.T)[:, own]


def test_only_the_law_s_own_parameters_are_sampled(marginal):
    assert marginal.own.sum() == len(marginal.task.law.plain.names)
    assert not marginal.own[marginal.own.sum() :].any()


def test_the_rest_is_left_where_nothing_in_it_would_do_better(marginal, many):
    """Against least squares in the rest alone, the law's parameters held."""
    T, at = near(marginal, 3), marginal.task.mode
    density, rest = marginal(T)
    own, low_high = marginal.own, marginal.task.limits
    for t, log_density, x in zip(T, density, rest, strict=True):

        def whole(y, t=t):
            found = np.empty(len(own))
            found[own], found[~own] = t, y
            return found[None]

        best = least_squares(
            lambda y: many(whole(y))[0],
            x,
            jac=lambda y: many.jacobians(whole(y))[0][:, ~own],
            bounds=[side[~own] for side in low_high],
        )
        # A hundredth is what a seventh of a standard deviation costs; left where the fit ended it costs tens.
        here, there = (np.sum(many(whole(y)) ** 2) / 2 for y in (x, at[~own]))
        assert log_density == pytest.approx(-best.cost, abs=0.01)
        assert here == pytest.approx(best.cost, abs=0.01)
        assert there > best.cost + 10


def test_the_rest_is_drawn_as_wide_as_the_linear_covariance_has_it_with_the_law_held(marginal):
    T, own = np.tile(marginal.task.mode[marginal.own], (4000, 1)), marginal.own
    best = np.tile(marginal.task.mode[~own], (4000, 1))
    X, log_density = marginal.drawn(T, best, np.random.default_rng(1))
    np.testing.assert_array_equal(X[:, own], T)
    J = marginal.task.jacobian(marginal.task.mode)[:, ~own]
    held = np.sqrt(np.diag(np.linalg.inv(J.T @ J)))
    np.testing.assert_allclose(X[:, ~own].std(axis=0), held, rtol=0.06)
    # Of so many independent normal numbers, half the sum of squares is half their count.
    assert -log_density.mean() == pytest.approx((~own).sum() / 2, rel=0.05)
