"""Time of a session across acquisitions; values as JSON has them."""

import json

import numpy as np
import pytest

from instrument.stream.clock import SessionClock
from instrument.stream.jsonable import to_jsonable
from instrument.stream.raw import AcquisitionBegan, BlockAcquired

RATE_HZ = 100.0


def block(first, samples):
    counts = np.zeros((1, samples), np.int32)
    return BlockAcquired(first, samples, (1e-6,), (1.0,), (False,), (False,), counts)


@pytest.fixture
def clock():
    clock = SessionClock()
    clock.take(AcquisitionBegan(1, "hammer", RATE_HZ, ("force",)))
    clock.take(block(0, 250))
    return clock


def test_the_sample_counter_is_the_clock(clock):
    assert clock.end_s == 2.5
    assert clock.at(100) == 1.0


def test_a_later_acquisition_begins_where_the_one_before_has_ended(clock):
    clock.take(AcquisitionBegan(2, "sweep", 2 * RATE_HZ, ("base",)))
    assert clock.at(0) == 2.5
    clock.take(block(0, 100))
    assert clock.end_s == 3.0


def test_numbers_become_what_json_knows():
    value = {"a": np.float64(1.5), 2: (np.int64(3), np.array([1.0, np.nan])), "c": float("inf"), "d": None}
    found = to_jsonable(value)
    assert found == {"a": 1.5, "2": [3, [1.0, None]], "c": None, "d": None}
    assert json.loads(json.dumps(found, allow_nan=False)) == found
