"""A stop by a signal comes anywhere: the recorder goes on, and has the end of the run."""

import sys

import pytest
from sessions import configuration, point

from instrument.errors import RigStopped
from instrument.session.journal import SessionJournal
from instrument.session.recorder import Recorder
from instrument.session.storage import part_events
from instrument.stream.raw import SessionEnded

MOST_PLACES = 2_000
"""More than there are in a call of `record`, those of the standard library among them."""


def interrupted_at(place: int, call, *given) -> bool:
    """Call it, with a Ctrl-C before the bytecode instruction of a number; whether it came to that one."""
    left = [place]

    def trace(frame, what, _):
        frame.f_trace_opcodes = True
        if what == "opcode":
            left[0] -= 1
            if left[0] < 0:
                sys.settrace(None)
                raise KeyboardInterrupt
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        call(*given)
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


def begun(folder):
    journal = SessionJournal(folder)
    journal.begin(configuration())
    return journal


def test_the_end_is_recorded_wherever_in_a_record_the_stop_came(tmp_path):
    end = SessionEnded("stopped by the user", "")
    for place in range(MOST_PLACES):
        journal = begun(tmp_path / f"{place}.running")
        with Recorder(journal, []) as recorder:
            recorder.record(point(1))
            came = interrupted_at(place, recorder.record, point(2))
            recorder.record(end)
        recorder.check()
        events = [e for entry in journal.entries() for e in part_events(journal.folder / entry.file)]
        assert (events[0], events[-1]) == (point(1), end), place
        if not came:
            return
    raise AssertionError("never through")


def test_a_part_that_fails_after_a_stop_is_said(tmp_path, caplog):
    journal = begun(tmp_path / "s.running")

    def stopped():
        with Recorder(journal, []) as recorder:
            (journal.folder / "part-000001.tmp").mkdir()
            recorder.record(SessionEnded("stopped by the user", ""))
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        stopped()
    assert [r.getMessage().split(": ")[1] for r in caplog.records] == ["recording failed"]


def test_a_part_that_fails_and_ends_the_run_is_said_by_that_alone(tmp_path, caplog):
    journal = begun(tmp_path / "s.running")

    def failed():
        with Recorder(journal, []) as recorder:
            (journal.folder / "part-000001.tmp").mkdir()
            while True:
                recorder.record(point(1))

    with pytest.raises(Exception, match="recording failed"):
        failed()
    assert caplog.records == []


def test_a_recorder_that_ended_says_why_at_once(tmp_path, monkeypatch):
    """What its thread died of is no slow disk."""

    def out_of_memory(self, event):
        raise MemoryError("no memory for a block")

    def failed():
        with Recorder(begun(tmp_path / "s.running"), []) as recorder:
            for n in range(100_000):
                recorder.record(point(n))

    monkeypatch.setattr(Recorder, "_take", out_of_memory)
    with pytest.raises(RigStopped, match="recording failed: no memory for a block"):
        failed()
