"""A velocity that is none: an input that stands still, points within their own noise."""

import numpy as np
import pytest
from sessions import point

from instrument.stepped_sine.lost_velocity import StillVelocity, lost_in_noise, noise_remarks

STILL, ALIVE = np.full(100, 0.3), np.sin(np.arange(100))
NOISY = {"remarks": tuple(noise_remarks(1e-9, 1e-9))}


def test_an_input_that_stands_still_for_three_readings_is_dead():
    still = StillVelocity()
    assert [(still.add(STILL), still.lost) for _ in range(3)] == [(True, False), (True, False), (True, True)]
    stop = still.stop(4, 20.0)
    assert "velocity lost" in stop.message
    assert "is the beam on the spot, the cable on" in stop.message


def test_a_reading_that_moves_begins_the_count_anew():
    still = StillVelocity()
    for velocity in (STILL, STILL, ALIVE, STILL, STILL):
        still.add(velocity)
    assert not still.lost


def test_points_within_their_noise_over_more_than_a_dip_of_the_response_end_the_run():
    points = [point(k, 20.0 + k, **NOISY) for k in range(1, 6)]
    assert lost_in_noise(points[:4]) == []
    (stop,) = lost_in_noise(points)
    assert (stop.step, stop.frequency_hz, stop.value) == (5, 25.0, 5)
    assert "velocity lost" in stop.message


def test_a_velocity_is_within_its_noise_below_three_of_its_standard_deviations():
    assert noise_remarks(2.9e-6, 1e-6) == ["velocity within its noise: 2.9 standard deviations"]
    assert noise_remarks(3.1e-6, 1e-6) == noise_remarks(0.0, 0.0) == []


@pytest.mark.parametrize("step_hz", [0.0, 0.1])
def test_a_dip_that_is_narrow_does_not(step_hz):
    assert lost_in_noise([point(k, 20.0 + step_hz * k, **NOISY) for k in range(9)]) == []


def test_one_point_out_of_its_noise_begins_the_count_anew():
    points = [point(k, 20.0 + 5 * k, **NOISY) for k in range(4)]
    assert lost_in_noise([*points, point(5, 45.0)]) == []
    assert lost_in_noise([*points, point(5, 45.0), point(6, 50.0, **NOISY)]) == []
