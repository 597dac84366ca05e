"""One segment read with another gain is named with its frequencies, and is no gain of all."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.effects import Points
from fitting.effects.segment_gain import SegmentGainEffect

F = np.concatenate([np.linspace(14, 25, 12), np.linspace(85, 115, 16), np.linspace(250, 310, 13)])
SEGMENT = np.repeat([1, 2, 3], [12, 16, 13])
EFFECT = SegmentGainEffect()


def points(levels=(9.81,)):
    n, many = len(F), len(levels)
    return Points(
        np.tile(2 * np.pi * F, many),
        np.repeat(np.array(levels), n),
        np.arange(float(n * many)),
        True,
        True,
        "relative",
        segment=np.tile(SEGMENT, many),
    )


def test_each_segment_is_a_start_of_its_own():
    starts = EFFECT.starts(None, points())
    assert [tuple(u[1:3]) for u in starts] == [
        pytest.approx(ends) for ends in ((14, 25), (85, 115), (250, 310))
    ]
    assert all(u[3] == 0 for u in starts)


def test_a_factor_is_of_its_segment_alone():
    u = EFFECT.starts(None, points())[1]
    u[0] = 1.05
    ratio = EFFECT.reading(np.ones(len(F), complex), points(), u)
    assert (ratio == np.where(SEGMENT == 2, 1.05, 1.0)).all()


def test_a_range_may_be_of_one_level():
    two = points((4.9, 9.81))
    starts = EFFECT.starts(None, two)
    assert len(starts) == 9
    only = next(u for u in starts if u[3] == 9.81)
    ratio = EFFECT.reading(np.ones(2 * len(F), complex), two, np.array([1.1, *only[1:]]))
    assert (ratio[: len(F)] == 1).all()
    assert (ratio[len(F) :][SEGMENT == 1] == 1.1).all()


def test_an_amplitude_of_each_point_is_no_level():
    one = points()
    each = replace(one, drive_amplitude=9.81 * (1 + 0.01 * np.sin(np.arange(len(F)))))
    assert all(u[3] == 0 for u in EFFECT.starts(None, each))


def test_a_level_is_read_with_its_gain_where_it_scatters():
    two = points((4.9, 9.81))
    each = replace(two, drive_amplitude=two.drive_amplitude * (1 + 0.01 * np.sin(np.arange(2 * len(F)))))
    starts = EFFECT.starts(None, each)
    assert len(starts) == 9
    ratio = EFFECT.reading(np.ones(2 * len(F), complex), each, np.array([1.1, *starts[2][1:]]))
    assert (ratio[: len(F)] == 1).all()
    assert (ratio[len(F) :][SEGMENT == 1] == 1.1).all()


def test_one_segment_has_none():
    one = replace(points(), segment=np.ones(len(F), int))
    assert EFFECT.objection(one, None)
    assert EFFECT.objection(replace(points(), segment=None), None)
    assert EFFECT.objection(points(), None) is None


def test_it_is_told_with_percent_and_range():
    u = {"factor": 1.05, "from": 85.0, "to": 115.0, "level": 0.0}
    assert EFFECT.story(u) == "the velocity channel reads +5 % off from 85 to 115 Hz alone"
