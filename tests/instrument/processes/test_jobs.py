"""Jobs in other processes, where a process dies (with real ones: tests/instrument/batch/test_kills.py)."""

import signal
from concurrent.futures.process import BrokenProcessPool
from functools import partial

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


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="signals of a thread are POSIX")
def test_a_process_of_jobs_holds_a_ctrl_c_back_from_its_first_moment():
    """By its own word it would be deaf only once it has loaded itself: a traceback of each until then."""
    kept = {}
    held = partial(signal.pthread_sigmask, signal.SIG_BLOCK)
    jobs.in_processes(held, [()], 2, kept.__setitem__)
    assert signal.SIGINT in kept[()]
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())
