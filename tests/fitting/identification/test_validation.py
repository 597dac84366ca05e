import numpy as np
import pytest

from fitting.identification.validation import validate

NOISE = np.full(4, 0.5)


def learnt_mean(data):
    """A stand-in fit: one number, the mean of what it may see."""
    return lambda points: 100 * (np.mean(data[points]) - data) / data


def test_every_point_is_predicted_from_the_others():
    data = np.array([1e6, 2e6, 3e6, 6e6])
    v = validate(np.ones(4, dtype=int), 1, learnt_mean(data), NOISE)
    others = (data.sum() - data) / 3
    assert v.leave_one_out_rms_percent == pytest.approx(np.sqrt(np.mean((100 * (others / data - 1)) ** 2)))
    assert v.held_out == ()


def test_dense_segments_are_held_out_whole():
    data = np.repeat([1e6, 2e6, 4e6], 20)
    segment = np.repeat([3, 5, 9], 20)
    v = validate(segment, 1, learnt_mean(data), np.full(60, 0.5))
    assert [h.segment for h in v.held_out] == [3, 5, 9]
    assert [h.rms_percent for h in v.held_out] == pytest.approx([200, 25, 62.5])
    assert all(h.noise_percent == 0.5 for h in v.held_out)
    assert v.leave_one_out_rms_percent is None


def test_one_segment_cannot_be_held_out_and_too_few_points_not_left_out():
    data = np.full(40, 1e6)
    one = validate(np.ones(40, dtype=int), 1, learnt_mean(data), np.full(40, 0.5))
    assert one.held_out == ()
    assert one.held_out_rms_percent is None
    few = validate(np.ones(4, dtype=int), 4, learnt_mean(data[:4]), NOISE)
    assert few.leave_one_out_rms_percent is None
