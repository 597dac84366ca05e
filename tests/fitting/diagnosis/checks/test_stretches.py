"""Of a sweep in one piece, what is predicted from the rest."""

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fitting.diagnosis.checks.stretches import stretches, words_of_stretches
from fitting.sweep import Sweep

LINE = np.linspace(10.0, 310.0, 301)
"""Hz."""


def test_it_is_cut_half_way_between_resonances():
    np.testing.assert_allclose(stretches(LINE, np.array([300.0, 20.0, 80.0])), [40.0, np.sqrt(80 * 300)])


def test_of_one_resonance_flanks_are_told_from_it():
    np.testing.assert_allclose(stretches(LINE, np.array([120.0])), [110.0, 210.0])


def test_of_many_resonances_those_closest_to_each_other_stay_together():
    many = np.array([20.0, 40.0, 70.0, 100.0, 105.0, 110.0, 180.0, 250.0])
    cuts = stretches(LINE, many)
    assert len(cuts) == 4
    assert len(np.unique(np.digitize([100.0, 105.0, 110.0], cuts))) == 1


def test_a_stretch_of_few_points_is_none():
    assert len(stretches(LINE, np.array([11.0, 12.0, 300.0]))) == 1
    assert len(stretches(LINE[:12], np.array([11.0, 20.0]))) == 0


@given(
    arrays(float, st.integers(0, 12), elements=st.floats(5.0, 400.0), unique=True),
    st.integers(2, 200),
)
def test_every_stretch_is_a_resonances_worth_of_points(resonances_hz, count):
    f = np.linspace(10.0, 310.0, count)
    parts = np.digitize(f, stretches(f, resonances_hz))
    sizes = np.unique(parts, return_counts=True)[1]
    assert len(sizes) <= 5
    assert len(sizes) == 1 or sizes.min() >= 8


def in_one_piece(frequency_hz):
    v, one = np.ones(len(frequency_hz), complex), np.ones(len(frequency_hz), int)
    return Sweep(frequency_hz, v, np.full(len(frequency_hz), 9.81), one, one)


def test_nothing_is_said_of_segments_or_of_few_points():
    whole = in_one_piece(LINE)
    parts = 1 + np.digitize(LINE, [100.0, 200.0])
    (said,) = words_of_stretches(whole, parts)
    assert said.endswith("segments 1 to 3 are its stretches of 10 to 99, 100 to 199, 200 to 310 Hz")
    assert words_of_stretches(replace(whole, segment=parts), parts) == ()
    assert words_of_stretches(whole.take(np.arange(9)), np.repeat([1, 2, 3], 3)) == ()
    assert words_of_stretches(whole, whole.segment) == ()
