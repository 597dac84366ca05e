"""The cost of an explanation beside its evidence integrated on a grid."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.diagnosis.inference.marginal import cost, log_determinant, probabilities
from fitting.diagnosis.inference.refitted import Refitted
from fitting.effects.base import Effect, EffectParameter, Tie
from fitting.laws.bent_law import BentLaw
from fitting.laws.constant import ConstantModulus

N = 60
LAW = ConstantModulus(0.5e6, 0.5)


class Placed(Effect):
    """An effect with one unknown that is as likely anywhere between its limits."""

    name, chance = "placed", 0.05
    parameters = (EffectParameter("x", "m", -0.5, 0.5, 0.1, neutral=None),)


class Small(Effect):
    """One with an unknown that is likely small."""

    name, chance = "small", 0.05
    parameters = (EffectParameter("size", "1", -10.0, 10.0, 0.1, spread=0.1),)


class TwoMountings(Effect):
    """One with an unknown in each of two mountings, the second's near the first's."""

    name, chance = "two_mountings", 0.05
    parameters = (*Small.parameters, EffectParameter("size_2", "1", -10.0, 10.0, 0.1, spread=0.1))
    tied_to = 0.05

    @property
    def ties(self):
        return (Tie(0, 1, self.tied_to),)


def linear(columns, data, stated=0, effects=(), law=LAW, noise_known=True):
    """The end of a fit of data = columns . (what is fitted) + noise of unit size, begun at zero.

    Columns are of the law's log parameters, of as many stated numbers, and of the effects' unknowns.
    """
    priors = law.bend_count + stated
    own = len(law.names)
    J = np.vstack([columns, np.zeros((priors, columns.shape[1]))])
    J[len(data) + stated :, own - law.bend_count : own] = np.eye(law.bend_count)
    J[len(data) : len(data) + stated, own : own + stated] = np.eye(stated)
    for tie in (tie for e in effects for tie in e.ties):
        row = np.zeros(columns.shape[1])
        row[own + stated + np.array([tie.first, tie.other])] = np.array([-1, 1]) / tie.sigma
        J, priors = np.vstack([J, row]), priors + 1
    start = -np.concatenate([data, np.zeros(priors)])
    at = -np.linalg.lstsq(J, start, rcond=None)[0]
    u = at[own:]
    return Refitted(
        effects=tuple(effects),
        law=law.with_logs(np.log(law.values) + at[:own]),
        u=u,
        velocity_m_s=data.astype(complex),
        residuals=start + J @ at,
        jacobian=J,
        data=len(data),
        free=np.ones(len(u), dtype=bool),
        stated=stated,
        noise_known=noise_known,
    )


def design(seed, count):
    return 40 * np.random.default_rng(seed).normal(size=(N, count))


def evidence(columns, data, stated, prior_densities):
    """-2 ln of the integral over law and unknowns on a grid, stated numbers integrated as the Gaussian they
    are.

    Without the density of N numbers of unit noise at zero.
    """
    own = columns.shape[1] - stated
    fixed = columns[:, 2 : 2 + stated]
    C = np.eye(N) + fixed @ fixed.T
    others = np.delete(columns, range(2, 2 + stated), axis=1)
    P = np.linalg.inv(C)
    best = np.linalg.solve(others.T @ P @ others, others.T @ P @ data)
    root = np.linalg.cholesky(np.linalg.inv(others.T @ P @ others))
    t = np.linspace(-7, 7, 25)
    grid = np.stack(np.meshgrid(*[t] * own, indexing="ij"), axis=-1).reshape(-1, own)
    at = best + grid @ root.T
    r = data - at @ others.T
    chi2 = np.sum((r @ P) * r, axis=1)
    log = -0.5 * chi2 + sum(np.log(d(at[:, k])) for k, d in enumerate(prior_densities))
    volume = np.linalg.det(root) * (t[1] - t[0]) ** own
    whole = np.log(np.sum(np.exp(log - log.max())) * volume) + log.max()
    return -2 * whole + np.linalg.slogdet(C)[1]


def searched(k):
    """Density of a log parameter of `LAW`, uniform over the range that is searched."""
    low, high = np.log(LAW.limits[k].search)
    return lambda p: (
        np.where((p > low - np.log(LAW.values[k])) & (p < high - np.log(LAW.values[k])), 1, 0) / (high - low)
    )


def odds(effect):
    return -2 * np.log(effect.chance / (1 - effect.chance))


PRIORS = {Placed: lambda u: np.full(len(u), 1.0), Small: lambda u: 0.1 / np.pi / (u**2 + 0.01)}


@pytest.mark.parametrize("stated", [0, 3])
@pytest.mark.parametrize("effect", [None, Placed, Small])
def test_of_a_linear_gaussian_model_it_is_the_exact_evidence(stated, effect):
    effects = [effect()] if effect else []
    columns = design(1, 2 + stated + len(effects))
    data = np.random.default_rng(2).normal(size=N) + columns[:, 2:] @ np.full(stated + len(effects), 0.3)
    priors = [searched(0), searched(1), *([PRIORS[effect]] if effect else [])]
    found = cost(linear(columns, data, stated, effects), None)
    expected = evidence(columns, data, stated, priors) + sum(odds(e) for e in effects)
    assert found == pytest.approx(expected, abs=0.02)


def test_an_unknown_beside_another_is_paid_for_by_how_near_it_was_expected():
    columns, effect = design(24, 4), TwoMountings()
    data = np.random.default_rng(25).normal(size=N) + columns[:, 2:] @ np.array([0.30, 0.38])
    found = cost(linear(columns, data, effects=[effect]), None)
    # In the first one and the difference, of which each has a density of its own.
    apart = columns.copy()
    apart[:, 2] += columns[:, 3]
    near = lambda d: np.exp(-((d / 0.05) ** 2) / 2) / (0.05 * np.sqrt(2 * np.pi))  # noqa: E731
    expected = evidence(apart, data, 0, [searched(0), searched(1), PRIORS[Small], near])
    assert found == pytest.approx(expected + odds(effect), abs=0.05)


def test_of_two_causes_the_one_whose_mountings_differ_so_much_is_likelier():
    """A difference of four standard deviations of one, and of one of the other."""
    columns = design(26, 4)
    data = np.random.default_rng(27).normal(size=N) + columns[:, 2:] @ np.array([0.1, 0.3])
    firm, loose = TwoMountings(), TwoMountings()
    loose.tied_to = 0.2
    costs = [cost(linear(columns, data, effects=[e]), None) for e in (firm, loose)]
    assert costs[0] - costs[1] == pytest.approx(16 - 1 - 2 * np.log(4), abs=1.0)


def test_a_bend_is_a_stated_number_of_the_law():
    """Columns of prior unit width weigh the same, whether the law or the plate has them."""
    law = BentLaw.over(LAW, np.array([50.0, 90.0]))
    columns, data = design(3, 2 + law.bend_count), np.random.default_rng(4).normal(size=N)
    bent = cost(linear(columns, data, law=law), None)
    assert bent == pytest.approx(cost(linear(columns, data, stated=law.bend_count), None), abs=1e-6)


def test_a_parameter_that_explains_nothing_costs_by_how_well_it_is_known():
    columns, data = design(5, 3), np.random.default_rng(6).normal(size=N)
    # Nothing along the last column beyond the other two.
    Q, _ = np.linalg.qr(columns)
    data = data - Q @ (Q.T @ data)
    plain = cost(linear(columns[:, :2], data), None)
    costs = []
    for size in (1.0, 10.0, 100.0):
        with_it = np.column_stack([columns[:, :2], size * Q[:, 2]])
        costs.append(cost(linear(with_it, data, effects=[Placed()]), None) - odds(Placed()) - plain)
    assert np.all(np.diff(costs) > 2)
    # Ten times as well known: 2 ln 10.
    assert costs[2] - costs[1] == pytest.approx(2 * np.log(10), abs=0.15)


def test_a_parameter_that_the_data_do_not_feel_costs_next_to_nothing():
    columns, data = design(7, 2), np.random.default_rng(8).normal(size=N)
    blind = linear(np.column_stack([columns, np.zeros(N)]), data, effects=[Placed()])
    extra = cost(blind, None) - odds(Placed()) - cost(linear(columns, data), None)
    assert 0 < extra < 1


def test_what_it_must_explain_to_pay_for_itself():
    """An effect of one unknown wins where it explains more than its odds and its narrowing."""
    columns, noise = design(9, 3), np.random.default_rng(10).normal(size=N)
    effect = Small()
    gains = []
    for size in np.linspace(0, 0.04, 9):
        data = noise + size * columns[:, 2]
        plain = cost(linear(columns[:, :2], data), None)
        gains.append(plain - cost(linear(columns, data, effects=[effect]), None))
    assert gains[0] < -odds(effect)
    assert gains[-1] > 20
    assert np.count_nonzero(np.diff(np.sign(gains))) == 1


def test_an_unlikely_effect_costs_its_odds():
    columns, data = design(11, 3), np.random.default_rng(12).normal(size=N)
    rare, common = Small(), Small()
    rare.chance, common.chance = 0.01, 0.5
    a, b = (cost(linear(columns, data, effects=[e]), None) for e in (rare, common))
    assert a - b == pytest.approx(2 * np.log(99))


def test_a_small_value_is_likelier_than_a_large_one():
    columns, data = design(13, 3), np.random.default_rng(14).normal(size=N)
    at = [
        cost(linear(columns, data + size * columns[:, 2], effects=[Small()]), None)
        for size in (0.0, 0.1, 3.0)
    ]
    assert at[1] - at[0] == pytest.approx(2 * np.log(2), abs=0.3)
    assert at[2] - at[0] == pytest.approx(2 * np.log(901), abs=0.3)


class OneSided(Effect):
    name, chance = "one_sided", 0.05
    parameters = (EffectParameter("size", "1", 0.0, 10.0, 0.1, spread=0.1),)


def test_well_within_its_limits_what_has_one_side_only_is_twice_as_likely_there():
    columns = design(15, 3)
    data = np.random.default_rng(16).normal(size=N) + 0.3 * columns[:, 2]
    one, both = (cost(linear(columns, data, effects=[e()]), None) for e in (OneSided, Small))
    assert both - one == pytest.approx(2 * np.log(2))


@pytest.mark.parametrize("deviations", [-3.0, -1.0, 0.0, 1.0])
def test_a_fit_that_a_limit_holds_has_only_what_lies_within(deviations):
    columns = design(26, 3)
    data = np.random.default_rng(27).normal(size=N)
    free = linear(columns, data)
    s = float(np.sqrt(np.linalg.inv(columns.T @ columns)[2, 2]))
    data = data + (deviations * s - free.u[0]) * columns[:, 2]
    held = linear(columns, data, effects=[OneSided()])
    if deviations <= 0:
        law = linear(columns[:, :2], data)
        held = replace(held, u=np.zeros(1), residuals=law.residuals)
    # The integral over its size, everything else as it comes out for each.
    u = np.linspace(0, 12 * s, 400)
    each = np.array([cost(linear(columns[:, :2], data - size * columns[:, 2]), None) for size in u])
    p = np.exp(-(each - each.min()) / 2) * 2 * PRIORS[Small](u)
    expected = each.min() - 2 * np.log(np.trapezoid(p, u)) + odds(OneSided)
    assert cost(held, None) == pytest.approx(expected, abs=0.06)


class Uneven(Effect):
    name, chance = "uneven", 0.02
    parameters = (EffectParameter("ratio", "1", 0.1, 10.0, 2.0, logarithmic=True, neutral=1.0),)


def test_of_a_ratio_at_its_limit_only_half_lies_within():
    columns, data = design(7, 3), np.zeros(N)
    found = linear(columns, data, effects=[Uneven()])
    middle, end = (cost(replace(found, u=np.array([ratio])), None) for ratio in (1.0, 10.0))
    assert end - middle == pytest.approx(2 * np.log(2), abs=1e-3)


def test_where_the_noise_is_unknown_only_ratios_count():
    columns, data = design(17, 3), np.random.default_rng(18).normal(size=N)

    def gain(scale):
        fits = [
            linear(columns[:, :2], data, noise_known=False),
            linear(columns, data, effects=[Placed()], noise_known=False),
        ]
        fits = [replace(f, residuals=scale * f.residuals, jacobian=scale * f.jacobian) for f in fits]
        return cost(fits[0], None) - cost(fits[1], None)

    assert gain(1.0) == pytest.approx(gain(37.0), abs=0.05)


@pytest.mark.parametrize("stated", [0, 5, 2 * N])
def test_a_worse_fit_costs_more_however_many_numbers_are_stated(stated):
    """Of a noise of unknown size: what is stated stays as well known as it is said."""
    columns, data = design(19, 2 + stated), np.random.default_rng(20).normal(size=N)
    one = linear(columns, data, stated=stated, noise_known=False)
    r = np.random.default_rng(21).normal(size=N)
    costs = [
        cost(replace(one, residuals=np.concatenate([size * r, np.zeros(stated)])), None)
        for size in (0.5, 1.0, 2.0, 4.0)
    ]
    assert np.all(np.diff(costs) > 0)


def test_what_a_stated_number_is_moved_costs_as_its_prior_says():
    columns, data = design(22, 4), np.random.default_rng(23).normal(size=N)
    one = linear(columns, data, stated=2, noise_known=False)
    r = one.residuals[:N]
    costs = [cost(replace(one, residuals=np.append(r, z)), None) for z in ([0.0, 0.0], [3.0, 0.0])]
    assert costs[1] - costs[0] == pytest.approx(9)


@pytest.mark.parametrize("stated", [0, 3])
def test_tempered_readings_are_worth_what_noisier_ones_would_be(stated):
    columns = design(28, 3 + stated)
    data = np.random.default_rng(29).normal(size=N) + 0.3 * columns[:, -1]
    data += 0.1 * columns[:, 2 : 2 + stated].sum(axis=1)
    for temper in (2.0, 30.0):
        found = cost(linear(columns, data, stated=stated, effects=[Small()]), None, temper)
        root = np.sqrt(temper)
        noisier = cost(linear(columns / root, data / root, stated=stated, effects=[Small()]), None)
        assert found == pytest.approx(noisier, abs=0.1)


def test_tempering_leaves_how_rare_an_effect_is():
    columns, data = design(13, 3), np.random.default_rng(14).normal(size=N)

    class Rare(Small):
        chance = 0.001

    fits = [linear(columns, data, effects=[e()]) for e in (Rare, Small)]
    differences = [cost(fits[0], None, t) - cost(fits[1], None, t) for t in (1.0, 50.0)]
    assert differences[0] == pytest.approx(differences[1])
    assert differences[0] > 0


def test_probabilities_follow_the_costs():
    costs = np.array([0.0, 2 * np.log(19), 1e4])
    assert probabilities(costs) == pytest.approx([0.95, 0.05, 0])
    assert probabilities(costs + 1e5) == pytest.approx([0.95, 0.05, 0])


def test_what_readings_met_to_the_last_digit_drown_keeps_a_cost():
    # Two numbers that all readings know as one, to 1e-18 of what else they are known by.
    drowned = 1e18 * np.ones((2, 2))
    assert np.isfinite(log_determinant(drowned))
    sound = np.array([[2.0, 1.0], [1.0, 3.0]])
    assert log_determinant(sound) == pytest.approx(np.log(5.0))
