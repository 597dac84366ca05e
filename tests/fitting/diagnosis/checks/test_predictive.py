"""Fits that leave noise and fits that leave more, checked by what data they would have left."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.data.readings import Readings
from fitting.diagnosis.checks.predictive import (
    checks,
    form_error,
    most_unrefused,
    passes,
    temper,
    weakest,
)
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.thresholds import VERDICT
from fitting.effects.base import Effect
from fitting.laws.constant import ConstantModulus
from fitting.laws.smooth import Smooth
from fitting.numerics.chances import chi2_above
from fitting.sweep import Sweep

N = 118
SWEEP = Sweep(
    frequency_hz=np.linspace(14, 300, 3 * N),
    velocity_m_s=np.ones(3 * N) + 0j,
    commanded_m_s2=np.full(3 * N, 9.81),
    segment=np.repeat([1, 2, 3], N),
    sweep=np.ones(3 * N, dtype=int),
)
SEGMENTS = np.array([np.tile(SWEEP.segment == k, 2) * 0.3 for k in (1, 2, 3)]).T
ONES = np.ones(3 * N)
EVIDENCE = Evidence(Readings(SWEEP.velocity_m_s), ONES, ONES, SEGMENTS, True)


class Rough(Effect):
    """Its formula may leave a hundredth of what it explains."""

    name, unexplained_share = "rough", 0.01


def fitted(r, z=(), effects=(), told=10.0):
    """The end of a fit that leaves `r` of the readings and has moved the stated numbers to `z`.

    `told`: how many standard deviations of the readings one of each of these moves them.
    """
    z = np.array(z, dtype=float)
    law = ConstantModulus(0.5e6, 0.5)
    residuals = np.concatenate([r, z])
    J = np.zeros((len(residuals), len(law.names) + len(z)))
    J[len(r) :, len(law.names) :] = np.eye(len(z))
    J[np.arange(len(z)), len(law.names) + np.arange(len(z))] = told
    return Refitted(
        effects=tuple(effects),
        law=law,
        u=z,
        velocity_m_s=SWEEP.velocity_m_s,
        residuals=residuals,
        jacobian=J,
        data=len(r),
        free=np.ones(len(z), dtype=bool),
        stated=len(z),
        noise_known=True,
    )


def white(seed):
    return np.random.default_rng(seed).normal(size=6 * N)


def checked(r, z=(), **how):
    one = fitted(r, z)
    return checks(SWEEP, how.get("evidence", EVIDENCE), one, one)


def test_noise_and_stated_numbers_as_expected_pass():
    worst = [weakest(checked(white(s), np.random.default_rng(s + 1000).normal(size=20))) for s in range(300)]
    assert min(p for _, p in worst) >= VERDICT.check_level


def test_every_tail_is_looked_at():
    found = checked(white(0), np.zeros(5))
    assert set(found) == {"size", "the model's own error", "tolerances", "signs", "memory"}
    assert all(0 <= p <= 1 for p in found.values())
    assert "tolerances" not in checked(white(0))


@pytest.mark.parametrize(
    ("what", "left", "z"),
    [
        ("size", lambda: 1.6 * white(1), ()),
        ("signs", lambda: white(2) + 1.5 * np.sin(np.arange(6 * N) / 9), ()),
        ("memory", lambda: np.convolve(white(3), [0.6, 0.6, 0.5], "same"), ()),
        ("tolerances", lambda: white(4), np.full(20, 2.0)),
        ("the model's own error", lambda: white(5) + 1.2 * SEGMENTS @ np.array([1.0, -1.0, 1.0]), ()),
    ],
)
def test_what_is_not_as_it_would_be_left_fails_by_name(what, left, z):
    found = checked(left(), z)
    assert not passes(found)
    assert found[what] < VERDICT.check_level


def test_stated_numbers_that_the_data_say_nothing_of_hide_none_that_they_do():
    z = np.zeros(25)
    z[:5] = 2.2
    told = np.where(np.arange(25) < 5, 10.0, 0.1)
    one = fitted(white(4), z, told=told)
    p = checks(SWEEP, EVIDENCE, one, one)["tolerances"]
    assert p == pytest.approx(chi2_above(5 * 2.2**2 / (1 - 1 / 101), 5), rel=1e-2)
    assert p < 2 * VERDICT.check_level < 1e-3 * chi2_above(z @ z, 25)
    nothing = fitted(white(4), z, told=0.1)
    assert checks(SWEEP, EVIDENCE, nothing, nothing)["tolerances"] == 1.0


def test_where_the_data_put_stated_numbers_scatters_as_it_is_expected_to():
    """Of 300 plates whose numbers are off as stated: one in a hundred below a hundredth, and none refused."""
    found = []
    for seed in range(300):
        rng = np.random.default_rng(seed)
        told = 10.0 ** rng.uniform(-1, 1, 20)
        true, noise = rng.normal(size=(2, 20))
        z = told * (told * true + noise) / (1 + told**2)
        one = fitted(white(seed), z, told=told)
        found.append(checks(SWEEP, EVIDENCE, one, one)["tolerances"])
    assert np.mean(np.array(found) < VERDICT.doubted) < 0.03
    assert np.quantile(found, [0.25, 0.5, 0.75]) == pytest.approx([0.25, 0.5, 0.75], abs=0.08)
    assert min(found) > VERDICT.check_level


@pytest.mark.parametrize(("loss_factor", "stands"), [(2.0, True), (0.9, True), (0.2, False)])
def test_a_law_without_a_formula_must_be_that_of_a_core(loss_factor, stands):
    rises = Smooth((10.0, 1000.0), (1e5, 1e7), (loss_factor, loss_factor))
    one = replace(fitted(white(0)), law=rises)
    found = checks(SWEEP, EVIDENCE, one, one)
    assert (found["causality"] >= VERDICT.check_level) == stands


def test_the_noise_itself_is_known_to_a_tenth_or_so():
    """Noise stated 20 % too small is no misfit, 60 % is."""
    assert passes(checked(1.2 * white(6)))
    assert not passes(checked(1.6 * white(6)))


def test_nothing_is_checked_where_the_noise_is_unknown():
    unknown = Evidence(Readings(SWEEP.velocity_m_s), ONES, ONES, SEGMENTS, False)
    assert checked(5 * white(7), evidence=unknown) == {}
    assert passes({})
    assert weakest({}) is None


def test_what_a_formula_may_leave_is_a_share_of_what_it_explains():
    none, one = fitted(100 * white(8)), fitted(white(8), effects=[Rough()])
    assert form_error(none, one) == pytest.approx(0.01 * (none.chi2 - one.chi2))
    assert temper(none, one) == pytest.approx(1 + form_error(none, one) / VERDICT.formula_shapes)
    # What explains nothing may leave nothing.
    assert form_error(one, none) == 0
    assert temper(one, one) == 1


class Exact(Rough):
    name, unexplained_share = "exact", 0.0


@pytest.mark.parametrize(("rough", "exact"), [(0.9, 0.001), (0.001, 0.9)])
def test_of_two_effects_each_formula_answers_for_what_its_effect_explains(rough, exact):
    """`rough`, `exact`: the share of what both explain that each does alone."""
    none, both = fitted(100 * white(8)), fitted(white(8), effects=[Rough(), Exact()])
    explained = none.chi2 - both.chi2
    alone = {"rough": none.chi2 - rough * explained, "exact": none.chi2 - exact * explained}
    shares = {"rough": 0.01, "exact": VERDICT.formula_share}
    first, second = ("rough", "exact") if rough > exact else ("exact", "rough")
    expected = (0.9 * shares[first] + 0.1 * shares[second]) * explained
    assert form_error(none, both, alone) == pytest.approx(expected)
    assert form_error(none, both) == pytest.approx(0.01 * explained)
    assert form_error(none, both, {"rough": 1.0}) == pytest.approx(0.01 * explained)


def test_a_large_effect_may_leave_what_a_small_one_may_not():
    left = 2.0 * white(9)
    small, large = fitted(1.1 * white(9)), fitted(60 * white(9))
    one = fitted(left, effects=[Rough()])
    assert checks(SWEEP, EVIDENCE, small, one)["size"] < VERDICT.check_level
    assert checks(SWEEP, EVIDENCE, large, one)["size"] > VERDICT.check_level
    # Stated numbers are held against it less, too.
    moved = fitted(white(9), np.full(20, 2.0), [Rough()])
    assert checks(SWEEP, EVIDENCE, small, moved)["tolerances"] < VERDICT.check_level
    assert checks(SWEEP, EVIDENCE, large, moved)["tolerances"] > VERDICT.check_level


def test_one_check_below_the_level_is_enough_to_fail():
    assert passes({"size": VERDICT.check_level, "signs": 0.5})
    assert not passes({"size": 0.99 * VERDICT.check_level, "signs": 0.5})
    assert weakest({"size": 0.3, "signs": 0.2}) == ("signs", 0.2)


@pytest.mark.parametrize("effects", [(), (Rough(),)])
def test_what_leaves_more_than_any_check_allows_is_refused(effects):
    none = fitted(20 * white(1), z=np.zeros(10))
    most = most_unrefused(none, effects)
    size = np.sqrt(1.01 * most / (6 * N))
    assert (
        checks(SWEEP, EVIDENCE, none, fitted(size * white(2), effects=effects))["size"] < VERDICT.check_level
    )
    moved = np.full(10, np.sqrt(most / 10))
    asked = checks(SWEEP, EVIDENCE, none, fitted(white(2), z=moved, effects=effects))
    assert asked["tolerances"] < VERDICT.check_level


def test_what_no_check_refuses_is_below_what_is_never_refused():
    none = fitted(20 * white(1), z=np.zeros(10))
    one = fitted(1.3 * white(2), z=np.full(10, 1.5), effects=(Rough(),))
    assert passes(
        {k: p for k, p in checks(SWEEP, EVIDENCE, none, one).items() if k in ("size", "tolerances")}
    )
    assert one.chi2 < most_unrefused(none, one.effects)
