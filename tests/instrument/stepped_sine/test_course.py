import numpy as np
import pytest

from instrument.stepped_sine.settings import SweepSettings
from instrument.stepped_sine.settling_trace import SettlingTrace, begins_at
from instrument.stream.raw import RangeSet, ShakerCommanded

RATE, FREQUENCY, DECAY_1_S = 2000.0, 25.0, 4.0
SETTINGS = SweepSettings()
RANGE = RangeSet("5mm/s/V", 5e-3, 100.0, 5000.0, None)


def ringing(count, transient=0.0, noise=0.0):
    """Base and velocity, a transient of a neighbouring mode on the velocity."""
    t = np.arange(count) / RATE
    rng = np.random.default_rng(3)
    base = 9.81 * np.cos(2 * np.pi * FREQUENCY * t)
    velocity = 0.1 * np.sin(2 * np.pi * FREQUENCY * t)
    velocity += 0.1 * transient * np.exp(-DECAY_1_S * t) * np.sin(2 * np.pi * (FREQUENCY + 1) * t)
    return np.stack([base, velocity]) + noise * rng.normal(size=(2, count)) * np.array([[9.81], [0.1]])


def followed(x, pieces=1, begin=0):
    course = SettlingTrace(FREQUENCY, DECAY_1_S, RATE, begin, SETTINGS)
    first = 0
    for piece in np.array_split(x, pieces, axis=1):
        course.add(first, piece)
        first += piece.shape[1]
    while course.read():
        pass
    return course


def test_the_bound_lies_above_the_transient_that_is_there():
    course = followed(ringing(4000, transient=0.3))
    block_s = SETTINGS.block_s(FREQUENCY)
    for standing in course.standings[1:]:
        # The transient as it was in the middle of the block fitted.
        there = 0.3 * np.exp(-DECAY_1_S * (standing.seconds - block_s / 2))
        assert standing.remaining > 0.8 * there
    assert course.standings[-1].remaining < 0.05
    assert course.standings[-1].base_m_s2 == pytest.approx(9.81)


def test_it_does_not_matter_how_the_samples_are_cut():
    x = ringing(3000, transient=0.3)
    assert followed(x).standings == followed(x, pieces=17).standings


def test_what_noise_alone_allows_lies_above_what_it_does():
    course = followed(ringing(20_000, noise=1e-3))
    steady = course.standings[2:]
    assert sum(s.remaining < s.noise for s in steady) > 0.9 * len(steady)
    assert steady[-1].noise < 1


def test_samples_before_the_change_took_effect_do_not_count():
    assert len(followed(ringing(2000), begin=1000).standings) < len(followed(ringing(2000)).standings)


def test_it_begins_again_behind_a_gap():
    course = SettlingTrace(FREQUENCY, DECAY_1_S, RATE, 0, SETTINGS)
    x = ringing(4000)
    course.add(0, x[:, :1000])
    course.add(1500, x[:, 1500:])
    while course.read():
        pass
    assert course.standings[0].remaining == np.inf
    assert all(s.remaining < 1e-6 for s in course.standings[1:])


def test_a_change_takes_effect_when_the_shaker_says_or_after_what_is_allowed_for_it():
    known = ShakerCommanded(1, FREQUENCY, 1.0, 0.05, 700)
    unknown = ShakerCommanded(1, FREQUENCY, 1.0, 0.05, None)
    allowed = round(SETTINGS.latency_s * RATE)
    assert begins_at(known, 500, RATE, SETTINGS) == 700 + 100 + 1
    assert begins_at(unknown, 500, RATE, SETTINGS) == 500 + allowed + 100 + 1
    assert begins_at(RANGE, 500, RATE, SETTINGS) == 500 + allowed
