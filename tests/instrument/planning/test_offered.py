"""Which measurements the steps of one place are made in."""

import numpy as np
import pytest

from fitting.sweep import Sweep
from instrument.planning.offered import MOST, Offered, again
from instrument.planning.steps import Steps, no_steps


def steps(*segments, count=MOST):
    segment = np.repeat(segments, count)
    return Steps(100.0 * segment + np.tile(np.arange(count), len(segments)), segment, np.ones(len(segment)))


def counts(choices, offered):
    """Steps of each segment, of each choice."""
    found = []
    for one in choices:
        number, count = np.unique(offered.steps.of(one.at).segment, return_counts=True)
        found.append(dict(zip(number.tolist(), count.tolist(), strict=True)))
    return found


def test_the_segments_are_swept_in_two_lengths_with_gaps_and_twists_or_without():
    offered = Offered(steps(1, 2), steps(3, count=7), steps(4, count=5), "88")
    short, long, gap, twist = {1: 20, 2: 20}, {1: 40, 2: 40}, {3: 7}, {4: 5}
    expected = [twist, short, short | twist, long, long | twist]
    expected += [short | gap, short | gap | twist, long | gap, long | gap | twist]
    found = list(offered.choices())
    assert counts(found, offered) == expected
    assert found[-1].words == (
        "sweep the same segments, 40 steps each, and between them, and measure its twist, about 88 Hz"
    )
    assert counts(offered.each_gap(), offered) == [gap]
    assert offered.known.sum() == len(offered.same)


def test_where_there_is_neither_gap_nor_twist_the_segments_remain():
    offered = Offered(steps(1), no_steps(), no_steps())
    assert counts(offered.choices(), offered) == [{1: 20}, {1: 40}]
    assert not list(offered.each_gap())


def test_a_short_sweep_goes_from_end_to_end():
    offered = Offered(steps(1), no_steps(), no_steps())
    f = offered.steps.of(next(offered.lengths()).at).frequency_hz
    assert (f[0], f[-1]) == (100.0, 100.0 + MOST - 1)
    assert np.ptp(np.diff(f)) <= 1


def test_further_steps_lie_as_evenly_as_those_of_before_and_in_their_order():
    f = np.concatenate([np.geomspace(200, 230, 60), np.geomspace(20, 25, 60)])
    segment = np.repeat([2, 1], 60)
    # The second resonance first, the lower one from its upper end.
    f[60:] = f[60:][::-1]
    sweep = Sweep(f, np.ones(120, complex), np.ones(120), segment, segment)
    found, numbers = again(sweep, np.arange(120.0))
    assert numbers.tolist() == [2] * MOST + [1] * MOST
    assert np.diff(np.log(found[:MOST])) == pytest.approx(np.log(230 / 200) / (MOST - 1), rel=1e-2)
    assert (found[MOST], found[-1]) == (25.0, 20.0)


def test_a_segment_of_one_step_is_read_once():
    sweep = Sweep(np.array([50.0]), np.ones(1, complex), np.ones(1), np.ones(1, int), np.ones(1, int))
    found, numbers = again(sweep, np.zeros(1))
    assert (found.tolist(), numbers.tolist()) == ([50.0], [1])
    offered = Offered(Steps(found, numbers, np.ones(1)), no_steps(), no_steps())
    assert [len(c.at) for c in offered.lengths()] == [1, 1]
