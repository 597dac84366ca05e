"""Blows caught in a stream of samples."""

import numpy as np
import pytest

from instrument.hammer_test.trigger import LEARN_S, Trigger

RATE, RECORD_S, BEFORE_S, OFFSET = 1000, 0.2, 0.02, 5.0


def stream(*blows, seconds=2.0, noise=0.01):
    """Force about an offset with blows (at s, peak), and a response. Shape (2, samples)."""
    rng = np.random.default_rng(2)
    x = noise * rng.standard_normal((2, round(seconds * RATE)))
    x[0] += OFFSET
    for at_s, peak in blows:
        x[0, round(at_s * RATE) : round(at_s * RATE) + 3] += peak
    return x


def records(x, lengths):
    """Found in pieces of these lengths, over and over."""
    trigger, found, at = Trigger(RATE, RECORD_S, BEFORE_S), [], 0
    while at < x.shape[1]:
        for n in lengths:
            found += trigger.feed(at, x[:, at : at + n], np.zeros(2, bool))
            at += n
    return trigger, found


@pytest.mark.parametrize("lengths", [(2000,), (7, 113), (200,), (1, 2)])
def test_a_record_is_the_same_however_the_stream_is_cut(lengths):
    x = stream((0.6, 10), (1.2, -8))
    trigger, found = records(x, lengths)
    assert [first for first, _, _ in found] == [580, 1180]
    for first, rows, _ in found:
        assert np.array_equal(rows, x[:, first : first + 200])
    assert trigger.peaks == pytest.approx((10, 8), abs=0.1)


def test_no_blow_is_caught_while_the_quiet_is_learnt_and_none_in_noise():
    assert Trigger(RATE, RECORD_S, BEFORE_S).level is None
    trigger, found = records(stream(), (100,))
    assert found == []
    assert trigger.level == pytest.approx(30 * 0.01, rel=0.2)
    assert trigger.wanted == round(LEARN_S * RATE)


def test_after_a_hard_blow_handling_is_not_taken_for_another():
    assert len(records(stream((0.6, 0.8)), (100,))[1]) == 1
    trigger, found = records(stream((0.6, 10), (1.2, 0.8)), (100,))
    assert len(found) == 1
    assert trigger.level == pytest.approx(1.0, rel=0.01)


def test_a_pending_record_says_how_much_it_lacks():
    trigger, x = Trigger(RATE, RECORD_S, BEFORE_S), stream((0.6, 10))
    assert trigger.feed(0, x[:, :700], np.zeros(2, bool)) == []
    assert trigger.wanted == 80
    ((first, rows, _),) = trigger.feed(700, x[:, 700:780], np.zeros(2, bool))
    assert (first, rows.shape) == (580, (2, 200))


def test_an_overload_marks_its_channel_of_the_records_it_falls_into():
    trigger, x = Trigger(RATE, RECORD_S, BEFORE_S), stream((0.6, 10), (1.2, 10))
    found = []
    for at in range(0, 2000, 100):
        found += trigger.feed(at, x[:, at : at + 100], np.array([False, at == 1300]))
    assert [flags.tolist() for _, _, flags in found] == [[False, False], [False, True]]
