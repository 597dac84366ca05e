"""A step's transient is bounded from block to block, whatever its frequency; samples wait in a row."""

import numpy as np
import pytest

from instrument.stepped_sine.samples import Samples
from instrument.stepped_sine.settling import Settling

DECAY_1_S, BLOCK_S, TOLERANCE = 2.0, 0.1, 1e-3


@pytest.mark.parametrize("beat_hz", [0.0, 0.3, 5.0, 9.9])
def test_settled_is_said_only_when_the_transient_is_within_its_tolerance(beat_hz):
    q = np.exp((-DECAY_1_S + 2j * np.pi * beat_hz) * BLOCK_S)
    settling = Settling(DECAY_1_S, TOLERANCE)
    left = [0.5 * q**k for k in range(200)]
    settled = [settling.add(1 + x, 1e-9, BLOCK_S) for x in left]
    first = settled.index(True)
    assert abs(left[first]) <= TOLERANCE * 1.001
    assert not any(settled[:first])


def test_a_response_that_stands_still_has_settled_at_the_second_reading():
    settling = Settling(DECAY_1_S, TOLERANCE)
    assert not settling.add(1 + 1j, 1e-9, BLOCK_S)
    assert settling.add(1 + 1j, 1e-9, BLOCK_S)
    assert settling.remaining == 0


def test_in_noise_it_waits_as_long_as_the_decay_expected_asks():
    rng, settling, std = np.random.default_rng(1), Settling(DECAY_1_S, 1e-6), 1e-3
    waited = 0
    while not settling.add(1 + std * (rng.normal() + 1j * rng.normal()) / 2, std, BLOCK_S):
        waited += 1
    assert settling.noise > settling.tolerance
    assert waited * BLOCK_S >= settling.predicted_s - BLOCK_S


def test_samples_are_taken_from_where_the_command_took_effect():
    x = np.arange(24.0).reshape(2, 12)
    samples = Samples(2)
    for at in (0, 4, 8):
        samples.add(at, x[:, at : at + 4], begin=6)
    assert (samples.first, samples.count, samples.end) == (6, 6, 12)
    first, taken = samples.take(5)
    assert first == 6
    np.testing.assert_array_equal(taken, x[:, 6:11])
    assert (samples.first, samples.count) == (11, 1)
    samples.clear()
    assert (samples.first, samples.count, samples.end) == (None, 0, 0)
