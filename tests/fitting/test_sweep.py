"""A sweep with fewer points is spread as the whole one."""

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
