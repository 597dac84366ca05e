"""Blows caught from a stream, judged, accepted and revised."""

import numpy as np
import pytest

from instrument.hammer_test.analysis import HammerAnalysis, HammerSettings
from instrument.stream.derived import DampingFound, HitJudged, HitRevised
from instrument.stream.raw import BlockAcquired, HammerTestEnded, OperatorDid
from instrument.stream.scaling import Scaling

RATE = 2048.0
RECORD_S = 6.0
MODES = ((17.7, 0.01), (59.8, 0.006))
SETTINGS = HammerSettings(hits=3, record_s=RECORD_S, pre_trigger_s=0.05, band_hz=(5.0, 200.0))
SCALING = Scaling({"force": 0, "response": 1}, {"force": 50.0, "response": 100.0})


def stream(blows, seconds, seed=0, clip_v=10.0):
    """Volts of force and response; `blows` are (time, peak in N)."""
    t = np.arange(round(seconds * RATE)) / RATE
    random = np.random.default_rng(seed)
    force, response = np.zeros_like(t), np.zeros_like(t)
    width = 4e-3
    for at, peak in blows:
        inside = (t >= at) & (t < at + width)
        force += np.where(inside, peak / 2 * (1 - np.cos(2 * np.pi * (t - at) / width)), 0)
        since = np.maximum(t - at - width / 2, 0)
        for f, ratio in MODES:
            w = 2 * np.pi * f
            response += peak * 0.05 * np.exp(-ratio * w * since) * np.cos(w * since) * (t > at + width / 2)
    x = np.stack([force / 50.0, response / 100.0]) + 2e-5 * random.standard_normal((2, len(t)))
    return np.clip(x, -clip_v, clip_v), np.abs(x) > clip_v


def feed(analysis, volts, over, size=333):
    found = []
    for first in range(0, volts.shape[1], size):
        part = volts[:, first : first + size]
        flags = tuple(bool(v) for v in over[:, first : first + size].any(axis=1))
        counts = np.rint(part / 1e-6).astype(np.int32)
        found += analysis.block(
            BlockAcquired(first, part.shape[1], (1e-6, 1e-6), (10.0, 10.0), flags, (False, False), counts)
        )
    return found


def caught(blows, seconds, size=333):
    analysis = HammerAnalysis(SETTINGS, SCALING, RATE)
    return analysis, feed(analysis, *stream(blows, seconds), size)


def test_every_blow_is_caught_with_its_pre_trigger():
    _, hits = caught([(1.0, 100.0), (9.0, 80.0), (17.0, 120.0)], 25.0)
    assert [h.hit for h in hits] == [1, 2, 3]
    assert all(h.accepted for h in hits)
    assert [h.peak_n for h in hits] == pytest.approx([100.0, 80.0, 120.0], rel=0.01)
    starts = np.array([h.first_sample for h in hits]) / RATE
    np.testing.assert_allclose(starts, np.array([1.0, 9.0, 17.0]) - 0.05, atol=2e-3)


@pytest.mark.parametrize("size", [1, 50, 100_000])
def test_hits_do_not_depend_on_how_the_stream_is_cut(size):
    blows, seconds = [(1.0, 100.0)], 8.0
    assert caught(blows, seconds, size)[1] == caught(blows, seconds)[1]


def test_a_double_blow_is_left_out_and_says_why():
    _, (hit,) = caught([(1.0, 100.0), (1.05, 30.0)], 8.0)
    assert not hit.accepted
    assert "double hit" in hit.why


def test_a_weak_blow_is_left_out_once_others_are_known():
    _, hits = caught([(1.0, 100.0), (9.0, 100.0), (17.0, 20.0)], 25.0)
    assert [h.accepted for h in hits] == [True, True, False]
    assert "weak" in hits[2].why


def test_an_overload_is_left_out():
    _, (hit,) = caught([(1.0, 700.0)], 8.0)
    assert not hit.accepted
    assert "overload" in hit.why


def test_blows_refused_are_counted_back_to_the_last_good_one():
    analysis, _ = caught([(1.0, 700.0), (9.0, 100.0), (17.0, 100.0), (17.05, 30.0), (25.0, 700.0)], 33.0)
    double, overload = analysis.rejected_in_a_row
    assert "double hit" in double
    assert "overload" in overload
    analysis.operator(OperatorDid("accepted", "", 0))
    assert analysis.rejected_in_a_row == []


def test_a_blow_that_was_too_hard_makes_none_after_it_weak():
    _, hits = caught([(1.0, 900.0), (9.0, 100.0)], 16.0)
    assert [h.accepted for h in hits] == [False, True]


def test_silence_is_no_blow():
    analysis, hits = caught([], 10.0)
    assert hits == []
    assert analysis.ready
    assert not analysis.complete


def test_a_hit_is_rejected_and_the_rejection_undone():
    analysis, _ = caught([(1.0, 100.0), (9.0, 80.0)], 16.0)
    assert analysis.operator(OperatorDid("rejected", "", 1)) == [HitRevised(1, False)]
    assert analysis.accepted == 1
    assert analysis.operator(OperatorDid("undone", "", 1)) == [HitRevised(1, True)]
    assert analysis.accepted == 2


def test_the_last_hit_is_meant_where_no_number_is_given_and_a_wrong_number_changes_nothing():
    analysis, _ = caught([(1.0, 100.0), (9.0, 80.0)], 16.0)
    assert analysis.operator(OperatorDid("rejected", "")) == [HitRevised(2, False)]
    assert analysis.operator(OperatorDid("rejected", "", 7)) == []


def test_enough_good_hits_end_the_test_with_the_modes():
    analysis, _ = caught([(1.0, 100.0), (9.0, 80.0), (17.0, 120.0)], 25.0)
    assert analysis.complete
    (found,) = analysis.ended(HammerTestEnded())
    assert isinstance(found, DampingFound)
    modes = found.result.modes
    assert [m.frequency_hz for m in modes] == pytest.approx([17.7, 59.8], rel=2e-3)
    assert [m.damping_ratio for m in modes] == pytest.approx([0.01, 0.006], rel=0.02)


def test_without_a_good_hit_there_are_no_modes():
    analysis, hits = caught([(1.0, 100.0), (1.05, 30.0)], 8.0)
    assert isinstance(hits[0], HitJudged)
    assert analysis.ended(HammerTestEnded()) == []
