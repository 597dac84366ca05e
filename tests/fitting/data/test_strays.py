"""Readings that are none are found, and nothing that a structure does is taken for one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fitting.data.strays import strays
from fitting.sweep import Sweep

F = np.linspace(14.0, 26.0, 121)


def sweep(v, f=F):
    ones = np.ones(len(f), dtype=int)
    return Sweep(f, v, np.full(len(f), 9.81), segment=ones, sweep=ones)


def modes(f, resonances, losses, seed=0):
    rng = np.random.default_rng(seed)
    each = zip(resonances, losses, strict=True)
    return 1j * f * sum(rng.uniform(0.3, 1) / (p**2 * (1 + 1j * eta) - f**2) for p, eta in each)


def noisy(v, rng, share=3e-3):
    return v * (1 + share * (rng.normal(size=len(v)) + 1j * rng.normal(size=len(v))))


def test_readings_off_by_a_third_are_found_with_how_far_they_are_off():
    clean = noisy(modes(F, [19.0], [0.1]), np.random.default_rng(1))
    v = clean.copy()
    at = np.array([20, 70, 72, 100])
    v[at] *= [1.4, 0.7, 1.5, 0.2]
    off = strays(sweep(v))
    assert (np.flatnonzero(off) == at).all()
    assert off[at] == pytest.approx(np.abs(v - clean)[at], rel=0.1)


@pytest.mark.parametrize("count", [2, 4, 8])
def test_a_signal_lost_for_some_readings_is_found_however_smooth_its_floor(count):
    v = noisy(modes(F, [19.0], [0.1]), np.random.default_rng(2))
    v[60 : 60 + count] = 1e-2 * v[60 : 60 + count]
    assert (np.flatnonzero(strays(sweep(v))) == np.arange(60, 60 + count)).all()


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    count=st.integers(1, 8),
    loss=st.floats(2e-3, 0.5),
    points=st.sampled_from([60, 200, 800]),
    share=st.floats(1e-4, 2e-2),
)
def test_no_reading_of_any_structure_is_set_aside(seed, count, loss, points, share):
    rng = np.random.default_rng(seed)
    f = np.linspace(10.0, 400.0, points)
    v = noisy(modes(f, rng.uniform(10, 400, count), np.full(count, loss), seed), rng, share)
    floor = 2e-3 * np.median(np.abs(v))
    v += floor * (rng.normal(size=points) + 1j * rng.normal(size=points))
    assert not strays(sweep(v, f)).any()


def test_what_is_off_in_a_fifth_of_a_curve_is_no_stray():
    rng = np.random.default_rng(3)
    v = noisy(modes(F, [19.0], [0.1]), rng)
    at = rng.choice(121, 24, replace=False)
    v[at] *= rng.uniform(1.3, 3, 24)
    assert not strays(sweep(v)).any()


def test_amplitudes_and_a_few_points_say_nothing():
    v = noisy(modes(F, [19.0], [0.1]), np.random.default_rng(4))
    v[50] *= 3
    assert not strays(sweep(np.abs(v))).any()
    assert not strays(sweep(v[45:55], F[45:55])).any()


def test_the_order_of_points_carries_no_meaning():
    rng = np.random.default_rng(5)
    v = noisy(modes(F, [19.0], [0.1]), rng)
    v[[30, 31, 32, 80]] *= 0.1
    order = rng.permutation(121)
    assert strays(sweep(v[order], F[order])) == pytest.approx(strays(sweep(v))[order])


@pytest.mark.parametrize("seed", range(12))
def test_a_resonance_at_an_end_is_no_lost_signal(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.choice([18, 31, 60]))
    f = np.linspace(100.0, 300.0, n)
    width = 6 * (f[1] - f[0])
    end = rng.choice([100.0, 300.0]) + rng.uniform(-1, 1) * width
    v = modes(f, [end, rng.uniform(120, 280)], [width / end] * 2, seed)
    assert not strays(sweep(noisy(v, rng, 1e-5), f)).any()


ENDS = [slice(0, 1), slice(0, 3), slice(2, 5), slice(3, 5), slice(119, 121), slice(117, 121), slice(116, 119)]


@pytest.mark.parametrize("at", ENDS)
def test_a_signal_lost_at_an_end_is_found(at):
    v = noisy(modes(F, [19.0], [0.1]), np.random.default_rng(6))
    v[at] *= 1e-2
    assert (np.flatnonzero(strays(sweep(v))) == np.arange(121)[at]).all()


@pytest.mark.parametrize("digits", [2, 3, 4])
@pytest.mark.parametrize("of", [lambda v, d: np.round(v, d), lambda v, d: np.round(np.abs(v), d) + 0j * v])
def test_a_reading_in_steps_of_its_last_digit_is_none(digits, of):
    v = modes(F, [19.0], [0.02])
    v = v / np.abs(v).max()
    assert not strays(sweep(of(v, digits))).any()


def test_readings_of_nothing_are_no_curve():
    v = np.round(modes(F, [19.0], [0.02]) * 1e3)
    v[:40] = 0
    v[30] = 1.0
    assert not strays(sweep(v))[:25].any()
    assert not strays(sweep(np.zeros(121, complex))).any()
    assert not strays(sweep(np.ones(121, complex))).any()


def test_a_frequency_that_is_there_again_leaves_the_others_judged():
    v = noisy(modes(F, [19.0], [0.1]), np.random.default_rng(6))
    v[70] *= 1.5
    again = np.append(F, F[30]), np.append(v, v[30])
    off = strays(sweep(again[1], again[0]))
    assert (np.flatnonzero(off) == [70]).all()


def blown(seed, lines):
    """An FRF of blows: the force fades along the band, so noise grows by a factor of twelve."""
    f = np.linspace(60.0, 900.0, lines)
    rng = np.random.default_rng(seed)
    v = modes(f, np.geomspace(90, 850, 9), [0.05] * 9, seed)
    grows = np.exp(2.5 * ((f - f[0]) / np.ptp(f)) ** 4)
    return f, v + 1e-3 * grows * np.median(np.abs(v)) * (rng.normal(size=lines) + 1j * rng.normal(size=lines))


@pytest.mark.parametrize("lines", [300, 900])
def test_where_a_blow_s_force_has_little_noise_is_no_stray(lines):
    for seed in range(25):
        f, v = blown(seed, lines)
        assert not strays(sweep(v, f)).any()
        v[lines // 3] *= 3
        # Three hundred lines are too few to follow these resonances by.
        assert set(np.flatnonzero(strays(sweep(v, f)))) in ([{300}] if lines == 900 else [{100}, set()])
