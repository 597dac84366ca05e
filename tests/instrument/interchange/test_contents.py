"""What is gathered from a session's events."""

import numpy as np
import pytest
from session_cases import RATE, SECONDS, SyntheticSession, configuration, whole_session
from sessions import contents_in

from instrument.errors import BadInput
from instrument.stream.derived import HitJudged
from instrument.stream.raw import OperatorDid


def test_points_are_steps_and_sentinels_in_order(contents):
    assert [p.step for p in contents.measured] == sorted(p.step for p in contents.measured)
    assert {p.purpose for p in contents.measured} == {"step", "sentinel"}
    assert len(contents.points) == 27 + 4
    assert len(contents.calibration_points) == 4


def test_times_follow_the_sample_counter(contents):
    first, second = contents.points[:2]
    seconds = (second.point.sample - first.point.sample) / RATE
    assert second.time_s - first.time_s == pytest.approx(seconds, abs=1e-9)


def test_an_acquisition_after_another_begins_where_that_ended(contents):
    """The hammer test and the calibration lie before the sweep, though its counter began at zero again."""
    hammer = 3 * (SECONDS + 1.5)
    assert contents.points[0].time_s > hammer + contents.points[0].point.sample / RATE


def test_a_resumed_run_goes_on_by_the_clock(tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.sweep(segments=(1,), steps=2)
    synthetic.begin("2026-04-01T09:00:05+00:00", resumed=True)
    synthetic.sweep(segments=(2,))
    synthetic.end()
    contents = contents_in(synthetic.save(tmp_path))
    early, late = (p.time_s for p in (contents.points[0], contents.points[-1]))
    assert late - early == pytest.approx(3600, abs=30)
    assert len(contents.began) == 2
    assert contents.segments[1, 1].ended is False
    assert contents.segments[1, 2].ended is True


def test_hits_are_the_samples_the_trigger_saw(contents):
    hit = contents.hits[2]
    assert [h.accepted for h in contents.hits] == [True, False, True]
    assert "double hit" in contents.hits[1].why
    assert len(hit.record.force_n) == SECONDS * RATE
    assert np.max(hit.record.force_n) == pytest.approx(hit.peak_n, rel=1e-3)
    # 50 ms of quiet lie before the blow.
    assert np.argmax(hit.record.force_n > 10) / RATE == pytest.approx(0.05, abs=3e-3)


def test_the_operators_word_counts(tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.hammer(rejected=(3,))
    synthetic.emit(OperatorDid("undone", "", 3))
    synthetic.emit(OperatorDid("rejected", "", 1))
    contents = contents_in(synthetic.save(tmp_path))
    assert [h.accepted for h in contents.hits] == [False, False, True]
    assert contents.hits[0].judged().why == "rejected"


def test_a_hammer_test_begun_again_replaces_the_first(tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.hammer(hits=3)
    synthetic.hammer(hits=1)
    contents = contents_in(synthetic.save(tmp_path))
    assert [h.number for h in contents.hits] == [1]


def test_without_hits_no_samples_are_read(session_path):
    contents = contents_in(session_path, with_hits=False)
    assert contents.hits == []
    assert contents.damping is not None


def test_a_killed_run_has_no_end(tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    assert contents_in(synthetic.save(tmp_path)).ended is None


def test_a_hit_without_its_samples_is_damage(tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.events.append(HitJudged(1, 0, 10, 5.0, True, ""))
    with pytest.raises(BadInput, match="hit 1: its samples are missing"):
        contents_in(synthetic.save(tmp_path))


def test_two_sessions_made_alike_are_alike(session_path, tmp_path):
    again = contents_in(whole_session(tmp_path))
    assert again.measured == contents_in(session_path).measured
