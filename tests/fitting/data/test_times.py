"""Times of points that can be seconds, and others."""

import numpy as np
import pytest

from fitting.data.times import are_seconds, is_timed
from fitting.sweep import Sweep

F = np.geomspace(14.0, 310.0, 350)
TIME_S = 2.8 * np.arange(350)


@pytest.mark.parametrize(
    ("times", "so"),
    [
        *((TIME_S, True), (1.7e9 + TIME_S, True), (TIME_S[::-1], True), (60 * TIME_S, True)),
        *(
            (np.zeros(350), False),
            (np.full(350, 1.7e9), False),
            (TIME_S / 3600, False),
            (1e3 * TIME_S, False),
        ),
    ],
)
def test_times_that_differ_as_readings_take_are_seconds(times, so):
    assert are_seconds(times, F) is so


def test_lines_of_a_spectrum_share_the_time_of_their_pass():
    assert are_seconds(np.repeat([0.0, 3600.0, 7200.0], 350), np.tile(F, 3))


def test_a_single_point_has_whatever_time_it_has():
    assert are_seconds(np.array([5.0]), np.array([20.0]))


def test_a_sweep_without_times_is_not_timed():
    one = np.ones(350, dtype=int)
    assert not is_timed(Sweep(F, F + 0j, np.ones(350), one, one))
    assert is_timed(Sweep(F, F + 0j, np.ones(350), one, one, time_s=TIME_S))
