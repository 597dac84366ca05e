"""Blows on the treated plate: the laser's range, the force's sign, what is too few."""

from dataclasses import replace

import numpy as np
import pytest

from instrument.hammer_test.analysis import HammerSettings
from instrument.hammer_test.struck import OVERLOADED, StruckAnalysis, settings_for
from instrument.stepped_sine.calibration import Calibration
from instrument.stream.derived import HitRevised, StruckFound
from instrument.stream.raw import BlockAcquired, HammerTestEnded, RangeSet, StrikingBegan
from instrument.stream.scaling import Scaling

RATE = 2048.0
HAMMER = HammerSettings(hits=2, record_s=6.0, pre_trigger_s=0.05, band_hz=(5.0, 200.0))
SCALING = Scaling({"force": 0, "velocity": 1}, {"force": 50.0, "velocity": 1.0})
FREE = StrikingBegan("free", (285.0, 180.0), (15.0, 20.0), (300.0, 200.0))
CLAMPED = StrikingBegan("clamped", (285.0, 100.0), None, (300.0, 200.0))
FINE, COARSE = (RangeSet(name, scale, 10.0, 1e5, None) for name, scale in (("fine", 0.1), ("coarse", 0.5)))
MODE_HZ, RATIO = 60.0, 0.03


def stream(seconds, blows, way, scale):
    """Volts: a plate that goes the other `way` as a whole, and rings."""
    t = np.arange(round(seconds * RATE)) / RATE
    noise = 1e-6 * np.random.default_rng(1).standard_normal((2, len(t)))
    force, v = np.zeros_like(t), np.zeros_like(t)
    for at in blows:
        since, w = t - at - 2e-3, 2 * np.pi * MODE_HZ
        force += np.where(abs(since) < 2e-3, 50 * (1 + np.cos(2 * np.pi * since / 4e-3)), 0)
        rings = np.exp(-RATIO * w * since.clip(0)) * np.cos(w * since)
        v += np.where(since > 0, 0.2 * (0.3 * rings - way * np.exp(-since.clip(0) / 5)), 0)
    return np.stack([force / 50.0, v / scale]) + noise


def fed(analysis, volts, first=0, over=False):
    found = []
    for k in range(0, volts.shape[1], 512):
        part = volts[:, k : k + 512]
        counts = np.rint(part / 1e-7).astype(np.int32)
        flags = (False, over)
        block = BlockAcquired(
            first + k, part.shape[1], (1e-7, 1e-7), (10.0, 10.0), flags, (False, False), counts
        )
        found += analysis.block(block)
    return found


def analysis_of(began=FREE, calibration=None):
    return StruckAnalysis(began, HAMMER, SCALING, RATE, (40.0, 90.0), FINE, lambda name: calibration)


def ended(analysis):
    (found,) = analysis.ended(HammerTestEnded())
    assert isinstance(found, StruckFound)
    return np.array(found.mobility_re_m_s_n) + 1j * np.array(found.mobility_im_m_s_n), found


def struck(way, **how):
    analysis = analysis_of(**how)
    hits = fed(analysis, stream(9.0, (1.0, 4.0, 7.0) if analysis.record_s < 3 else (1.0,), way, 0.1))
    return analysis, hits


def test_hung_free_a_short_record_is_enough_and_three_blows_are_wanted():
    assert settings_for(FREE, HAMMER).record_s == 2.0
    assert settings_for(CLAMPED, HAMMER).record_s == 6.0
    assert settings_for(FREE, HAMMER).hits == 3
    assert settings_for(FREE, replace(HAMMER, hits=5, record_s=1.0)) == replace(HAMMER, hits=5, record_s=1.0)


def test_whichever_side_it_was_struck_from_the_mobility_is_the_same():
    """At the corner across a plate goes the other way as a whole."""
    right, turned = (ended(struck(way)[0]) for way in (1.0, -1.0))
    assert all("not calibrated" in r for r in right[1].remarks)
    assert "the force's sign is turned" in turned[1].remarks[0]
    slow = 40.0
    assert right[1].frequency_hz[0] > slow


def test_gain_and_delay_of_a_calibrated_range_are_taken_off():
    raw, _ = ended(struck(1.0)[0])
    corrected, found = ended(struck(1.0, calibration=Calibration(1.1, 1e-3))[0])
    f = np.array(found.frequency_hz)
    np.testing.assert_allclose(corrected, raw / 1.1 * np.exp(2j * np.pi * f * 1e-3), rtol=1e-12)
    assert found.remarks == ()


def test_blows_read_in_another_range_are_let_go_of():
    analysis, hits = struck(1.0)
    assert [h.accepted for h in hits] == [True, True, True]
    assert analysis.range_set(FINE) == []
    assert analysis.range_set(COARSE) == [HitRevised(k, accepted=False) for k in (1, 2, 3)]
    assert analysis.accepted == 0
    assert analysis.ended(HammerTestEnded()) == []


def test_a_range_without_room_is_why_a_blow_is_refused():
    analysis = analysis_of()
    (hit,) = fed(analysis, stream(4.0, (1.0,), 1.0, 0.1), over=True)
    assert OVERLOADED in hit.why


@pytest.mark.parametrize("count", [0, 1])
def test_too_few_blows_give_nothing(count):
    analysis = analysis_of()
    fed(analysis, stream(4.0, (1.0,) * count, 1.0, 0.1))
    assert analysis.ended(HammerTestEnded()) == []
