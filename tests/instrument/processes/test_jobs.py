"""Jobs in other processes, where a process dies (with real ones: tests/instrument/batch/test_kills.py)."""

from concurrent.futures.process import BrokenProcessPool

import pytest

from instrument.processes import jobs


def test_a_job_that_ends_its_process_twice_is_named_where_nothing_stands_for_its_result(monkeypatch):
    def all_die(do, left, *_):
        died = [*left]
        left.clear()
        return died

    monkeypatch.setattr(jobs, "_until_one_dies", all_die)
    kept = {}
    with pytest.raises(BrokenProcessPool, match="a process ended while it was at sweep-1"):
        jobs.in_processes(str, ["sweep-1", "sweep-2"], 2, kept.__setitem__)
    assert kept == {}
