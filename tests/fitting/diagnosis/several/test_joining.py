"""Several members' sweeps and sums as one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fitting.diagnosis.several.joining import joined, joined_points, side_by_side
from fitting.effects.given import Points
from fitting.reduced.rational import RationalSweep
from fitting.sweep import Sweep


def sweep(segments, **more):
    n = len(segments)
    return Sweep(np.linspace(10, 20, n), np.ones(n), np.ones(n), np.array(segments), np.ones(n, int), **more)


def test_segments_are_numbered_on_from_file_to_file():
    found = joined([sweep([3, 3, 7]), sweep([1, 2, 2])])
    assert found.segment.tolist() == [1, 1, 2, 3, 4, 4]


def test_what_one_file_lacks_all_lack():
    timed = sweep([1, 1], time_s=np.array([0.0, 5.0]))
    assert joined([timed, timed]).time_s.tolist() == [0.0, 5.0, 0.0, 5.0]
    assert joined([timed, sweep([1, 1])]).time_s is None


@given(st.integers(0, 2**31), st.integers(1, 4), st.integers(1, 4))
def test_a_sum_beside_another_says_what_each_says_alone(seed, terms, others):
    rng = np.random.default_rng(seed)

    def some(points, terms, G_ref):
        # Poles off the positive real axis, as of a lossy plate.
        mu = rng.uniform(0.1, 1, (points, terms)) * np.exp(1j * rng.uniform(-0.5, 0.5, (points, terms)))
        c = rng.standard_normal((points, terms)) + 1j * rng.standard_normal((points, terms))
        return RationalSweep(np.arange(1.0, points + 1), G_ref, c, mu / abs(G_ref))

    each = [some(3, terms, 1e6 + 0j), some(2, others, 3e6 + 1e6j)]
    G = 1e6 * rng.uniform(0.5, 2, 5) * np.exp(1j * rng.uniform(0, 0.8, 5))
    alone = np.concatenate([each[0].displacement(G[:3]), each[1].displacement(G[3:])])
    assert side_by_side(each).displacement(G) == pytest.approx(alone, rel=1e-9)


def test_points_of_a_base_and_of_a_force_say_which_are_at_rest():
    def points(drive, reads):
        one = np.ones(2)
        return Points(2 * one, 3 * one, one, False, True, reads, drive)

    struck, shaken = points("force", "relative"), points("base", "absolute")
    both = joined_points([struck, shaken])
    assert (both.drive, both.reads) == ("base", "absolute")
    assert both.at_rest.tolist() == [True, True, False, False]
    assert both.base_m_s == pytest.approx([0, 0, -1.5j, -1.5j])
    assert shaken.base_m_s == pytest.approx([-1.5j, -1.5j])
    assert joined_points([shaken, shaken]).at_rest is None
    assert struck.base_m_s == joined_points([struck, struck]).base_m_s == 0.0
