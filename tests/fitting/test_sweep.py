"""Sweeps of fewer points, and the level at which a base really moved."""

from dataclasses import replace

import numpy as np

from fitting.sweep import Sweep


def sweep(f):
    one = np.ones(len(f), dtype=int)
    return Sweep(f, f + 0j, np.ones(len(f)), one, one, time_s=2 * f)


def test_thinned_it_keeps_its_ends_and_what_belongs_to_each_point():
    f = np.random.default_rng(0).permutation(np.linspace(20.0, 400.0, 1000))
    few = sweep(f).thinned(50)
    assert len(few) == 50
    assert (few.frequency_hz.min(), few.frequency_hz.max()) == (20.0, 400.0)
    assert np.diff(np.sort(few.frequency_hz)).max() < 1.1 * 380 / 49
    assert (few.time_s == 2 * few.frequency_hz).all()


def test_few_points_are_all_kept():
    one = sweep(np.linspace(20.0, 30.0, 7))
    assert one.thinned(7) is one


def test_a_base_that_moved_otherwise_than_commanded_has_a_level_of_its_own():
    asked = sweep(np.linspace(20.0, 30.0, 5))
    assert (asked.level_m_s2 == 1.0).all()
    near = replace(asked, base_m_s2=np.array([1.02, 0.97j, -1.05, 1.0, 0.93]))
    assert (near.level_m_s2 == 1.0).all()
    quarter = replace(asked, base_m_s2=np.array([0.25, 0.252j, -0.249, 1.0, 4.0]))
    assert quarter.level_m_s2.tolist() == [0.25, 0.252, 0.249, 1.0, 4.0]
    short = replace(near, drive_limited=np.array([False, True, False, False, True]))
    assert short.level_m_s2.tolist() == [1.0, 0.97, 1.0, 1.0, 0.93]
