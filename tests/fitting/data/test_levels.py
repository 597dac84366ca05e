"""What is a level, and that one stated point by point changes nothing that is smooth."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.data.hum import mains_hum
from fitting.data.levels import are_of, by_level, count_of_levels, to_one_level
from fitting.data.noise import groups_of, noise_of
from fitting.data.strays import strays
from fitting.sweep import Sweep

F = np.concatenate([np.linspace(14, 24, 40), np.linspace(85, 110, 40)])
RNG = np.random.default_rng(5)
NOISE = RNG.standard_normal((len(F), 2)) @ np.array([1, 1j])
RAMP = np.geomspace(1.0, 30.0, len(F))
JITTER = 9.81 * (1 + 0.02 * RNG.standard_normal(len(F)))
STEP = 9.81 * (1 + 1e-6 * np.arange(len(F)))


def sweep(level_m_s2):
    pole = sum(1 / (1 - (F / f) ** 2 + 0.1j * F / f) for f in (19.0, 98.0))
    per_level = pole * (1 + 3e-3 * NOISE)
    return Sweep(
        frequency_hz=F,
        velocity_m_s=per_level * level_m_s2,
        commanded_m_s2=level_m_s2,
        segment=np.repeat([1, 2], 40),
        sweep=np.ones(len(F), dtype=np.intp),
    )


@given(st.integers(1, 5), st.integers(3, 9), st.floats(1.2, 3.0), st.randoms())
def test_levels_are_told_apart_however_they_are_mixed(levels, of_each, ratio, random):
    number = np.repeat(np.arange(levels), of_each)
    random.shuffle(number)
    off = np.array([1 + 0.02 * random.random() for _ in number])
    parts = by_level(2.0 * ratio**number * off)
    assert [set(number[p]) for p in parts] == [{k} for k in range(levels)]
    assert all((np.diff(p) > 0).all() for p in parts)
    assert count_of_levels(2.0 * ratio**number) == levels


def test_an_amplitude_that_goes_up_with_frequency_is_no_level_for_each_point():
    assert len(by_level(np.geomspace(1, 100, 30))) == 1
    assert count_of_levels(np.geomspace(1, 100, 30)) > 10
    assert count_of_levels(JITTER) <= 2


def test_one_level_is_left_as_it_is_to_the_bit():
    assert (to_one_level(np.full(7, 9.80665)) == 1.0).all()


@pytest.mark.parametrize("level", [RAMP, JITTER, STEP], ids=["ramp", "jitter", "step"])
def test_a_level_of_each_point_changes_no_noise(level):
    one, each = sweep(np.full(len(F), 9.81)), sweep(level)
    assert len(groups_of(each)) == 2
    found, expected = noise_of(each), noise_of(one)
    assert found.source == "local scatter"
    assert found.std_m_s / level == pytest.approx(expected.std_m_s / 9.81, rel=1e-9)


@pytest.mark.parametrize("level", [RAMP, JITTER], ids=["ramp", "jitter"])
def test_a_level_of_each_point_hides_no_stray_and_makes_no_hum(level):
    one, each = sweep(np.full(len(F), 9.81)), sweep(level)
    assert mains_hum(each, noise_of(each)) is None
    assert not strays(each).any()
    spoilt = each.velocity_m_s.copy()
    spoilt[60] *= 1.5
    expected = replace(one, velocity_m_s=spoilt / level * 9.81)
    found = strays(replace(each, velocity_m_s=spoilt))
    assert np.flatnonzero(found).tolist() == [60]
    assert found / level == pytest.approx(strays(expected) / 9.81, rel=1e-9)


def test_a_level_holds_what_scatters_about_its_middle_and_not_the_next():
    two = np.concatenate([JITTER, 1.2 * JITTER.max() * np.ones(5)])
    middle = float(np.median(JITTER))
    near = np.abs(JITTER / middle - 1) < 0.04
    found = are_of(middle, two)
    assert found[: len(JITTER)][near].all()
    assert not found[len(JITTER) :].any()
