"""Readings on a grid, what limits a band, and a known mass: what a plan makes of what was measured."""

from types import SimpleNamespace

import numpy as np
import pytest
from planning_cases import aims, sensitivity

from fitting.planning.known_mass import KnownMass
from fitting.planning.limits import limited_by
from fitting.planning.measured import noise_seen, on_grid
from fitting.planning.sensitivity import ReadingNoise
from fitting.sweep import Sweep


def test_readings_of_one_frequency_are_averaged_by_their_noise():
    f, one = np.array([20.0, 10.0, 20.0]), np.ones(3, dtype=np.intp)
    v, std = np.array([2.0, 5.0 + 1j, 5.0]), np.array([1.0, 0.5, 2.0])
    found = on_grid(Sweep(f, v + 0j, np.ones(3), one, one, std_m_s=std), np.array([10.0, 15.0, 20.0]))
    assert found.taken.tolist() == [True, False, True]
    assert found.response_m_s[[0, 2]] == pytest.approx([5.0 + 1j, (2.0 + 5.0 / 4) / (1 + 1 / 4)])
    assert found.std_m_s[[0, 2]] == pytest.approx([0.5, (1 + 1 / 4) ** -0.5])


def test_a_floor_and_a_share_are_seen_in_the_noise_of_readings():
    made, v = ReadingNoise(2e-5, 3e-3), np.geomspace(1e-4, 1e-1, 12) + 0j
    dwell = np.resize([0.5, 2.0], 12)
    found = noise_seen(v, made.std_m_s(v, dwell), dwell)
    assert (found.floor_m_s, found.share) == (pytest.approx(2e-5, rel=1e-6), pytest.approx(3e-3, rel=1e-6))


def test_only_stated_numbers_that_would_tell_more_limit_a_band():
    s = sensitivity([50.0, 50.0], others=2)
    # Every reading feels the first of them alone: what it hides, it hides alone.
    s.rows[:, :, 2], s.rows[:, :, 3] = 50.0, 0.0
    ((name, left),) = limited_by(s, aims(), np.ones(2), [SimpleNamespace(name=n) for n in ("a", "b")])
    assert name == "a"
    # Known exactly, each part of the law is read twice, fifty standard deviations each time.
    assert left == pytest.approx(1 / (50 * np.sqrt(2)), rel=1e-3)


def test_a_known_mass_keeps_its_distance_from_the_free_end_wherever_the_clamp_begins():
    mass = KnownMass(2e-3, (0.25, 0.1), 0.01, 1e-3)
    assert mass.sigma_kg == pytest.approx(2e-5)
    assert mass.unknowns_on(0.3, 0.0) == pytest.approx([2e-3, 0.25, 0.1])
    kg, x, y = mass.unknowns_on(0.3, 0.004)
    # On the stretched plate places are shares of its length.
    assert 0.304 * (1 - x / 0.3) == pytest.approx(0.3 - 0.25)
    assert (kg, y) == (2e-3, 0.1)
    assert [q.fixed for q in mass.parameters] == [False, True, True]
