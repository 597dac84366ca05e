"""Frequencies that a sweep left out between its segments."""

import numpy as np
import pytest

from fitting.data.noise import noise_of
from fitting.sweep import Sweep
from instrument.planning.gaps import gaps_of, nearest, steps_between

MEASURED = np.concatenate([np.linspace(15, 25, 20), np.linspace(90, 110, 20), np.linspace(112, 130, 5)])


def test_gaps_lie_between_segments_and_not_in_them():
    assert gaps_of(MEASURED) == [(25.0, 90.0)]


def test_the_resonances_of_a_gap_are_among_its_steps_and_others_are_not():
    f = steps_between(25.0, 90.0, np.array([19.0 + 1j, 55.5 + 2j, 101.0 + 3j]))
    assert 55.5 in f
    assert f.min() > 25.0
    assert f.max() < 90.0
    assert np.all(np.diff(f) > 0)
    assert np.diff(np.log(f)).max() == pytest.approx(np.log(90 / 25) / 21, rel=1e-3)


def test_a_gap_without_resonances_leaves_the_noise_of_the_sweep_known():
    f = np.concatenate([np.linspace(15, 25, 20), steps_between(25.0, 90.0, np.array([200.0 + 1j]))])
    dice = np.random.default_rng(2).standard_normal((2, len(f)))
    v = (1e-2 + 1e-3j) * (1 + 0.01 * (dice[0] + 1j * dice[1])) * f / (f[0] + 0.1j * f)
    segment = np.where(f > 25, 2, 1)
    noise = noise_of(Sweep(f, v, np.ones(len(f)), segment, segment))
    assert noise.is_known
    assert np.median(noise.std_m_s / np.abs(v)) == pytest.approx(0.01, rel=0.4)


def test_what_was_measured_nearest_is_nearest_in_proportion():
    assert MEASURED[nearest(np.array([30.0, 46.0, 80.0]), MEASURED)].tolist() == [25.0, 25.0, 90.0]
