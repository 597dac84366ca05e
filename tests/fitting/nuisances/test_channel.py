"""What a stated velocity channel makes of a velocity, of one set of numbers and of many."""

import numpy as np
import pytest

from fitting.nuisances.channel import StatedChannel
from fitting.nuisances.nuisance import Nuisance

OMEGA = 2 * np.pi * np.array([20.0, 90.0, 250.0])
V = np.array([0.3 + 0.1j, -0.2 + 0.5j, 0.05 - 0.4j])
GAIN, DELAY, PHASE = (Nuisance(n, n, s) for n, s in (("gain", 0.01), ("delay", 1e-5), ("phase", 2e-3)))
LENGTH = Nuisance("length", "length", 3e-4)
Z = np.random.default_rng(3).normal(size=(5, 4))


@pytest.mark.parametrize("each", [(GAIN, LENGTH, DELAY, PHASE), (LENGTH, PHASE, LENGTH, LENGTH)])
def test_many_sets_of_numbers_are_read_as_each_by_itself(each):
    channel = StatedChannel(each)
    many = V * channel.factor(OMEGA, Z)
    for z, found in zip(Z, many, strict=True):
        np.testing.assert_array_equal(found, channel.reading(V, OMEGA, z))


def test_a_channel_without_stated_numbers_reads_what_is_there():
    assert StatedChannel((LENGTH,)).reading(V, OMEGA, np.array([2.0])) is V
    np.testing.assert_array_equal(StatedChannel(()).factor(OMEGA, np.zeros((2, 0))), np.ones((2, 3)))


def test_derivatives_of_many_readings_are_those_of_their_factor():
    channel, h = StatedChannel((GAIN, LENGTH, DELAY, PHASE)), 1e-4
    by = channel.by_reading(V * channel.factor(OMEGA, Z), OMEGA, Z)
    assert sorted(by) == [0, 2, 3]
    for k, found in by.items():
        step = h * np.eye(4)[k]
        up, down = (V * channel.factor(OMEGA, Z + s * step) for s in (1, -1))
        np.testing.assert_allclose(found, (up - down) / (2 * h), rtol=1e-6)
