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
    assert not settling.add(1 + 1j, 0.0, BLOCK_S)
    assert settling.add(1 + 1j, 0.0, BLOCK_S)
    assert settling.remaining == 0


def _left(settling: Settling, decay_1_s: float, std: float, rng: np.random.Generator) -> tuple[float, float]:
    """What is left when it is said to have settled, over the tolerance; and how long that took, in s."""
    x0, beat_hz = 1.5 * np.exp(1j * rng.uniform(0, 6)), 0.2 * rng.normal()
    for k in range(5000):
        x = x0 * np.exp((-decay_1_s + 2j * np.pi * beat_hz) * k * BLOCK_S)
        if settling.add(1 + x + std * (rng.normal() + 1j * rng.normal()), std, BLOCK_S):
            return abs(x) / settling.tolerance, k * BLOCK_S
    raise AssertionError("never")


@pytest.mark.parametrize("decay_1_s", [0.3, 3.0])
@pytest.mark.parametrize("std", [1e-5, 8e-4, 5e-3])
def test_noise_neither_hides_what_is_left_nor_makes_it_wait_for_ever(std, decay_1_s):
    rng = np.random.default_rng(1)
    found = np.array([_left(Settling(decay_1_s, TOLERANCE), decay_1_s, std, rng) for _ in range(60)])
    assert found[:, 0].max() <= 1.05
    assert np.median(found[:, 1]) * decay_1_s < 9


@pytest.mark.parametrize("std", [1e-5, 8e-4])
def test_a_decay_slower_than_the_specimens_is_seen_while_it_can_be(std):
    rng, stated, is_so = np.random.default_rng(2), 0.4, 0.28
    found = [_left(Settling(stated, TOLERANCE), is_so, std, rng)[0] for _ in range(60)]
    # Taken for as stated up to 0.0015^(0.28/0.4 - 1) = 7 times the tolerance would be left.
    assert np.median(found) < 1.1
    assert max(found) < 2.5


def test_what_does_not_decay_is_never_said_to_have_settled_while_it_moves():
    settling = Settling(0.0, TOLERANCE)
    assert not any(settling.add(1 + 0.1 * np.exp(0.3j * k), 1e-6, BLOCK_S) for k in range(300))


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


def test_a_response_of_nothing_is_followed():
    settling = Settling(DECAY_1_S, TOLERANCE)
    for response in (0j, 0j, 1e-12 + 0j, 0j):
        settling.add(response, 1.0, BLOCK_S)
    assert not np.isnan(settling.remaining)
