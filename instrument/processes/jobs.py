"""Many jobs in processes of their own: a few at a time, every result kept as it comes.

A process that is killed costs the jobs it had under way, which are done again.
"""

import os
import signal
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from multiprocessing import get_context
from typing import Any, TypeVar

from threadpoolctl import threadpool_limits

from instrument.processes.other_processes import VARIABLE as PROCESSES
from instrument.processes.other_processes import end_with, held_back

A = TypeVar("A")
B = TypeVar("B")

_AHEAD = 2
"""Jobs handed out for each process: the next one waits where the last one ends."""


def in_processes(
    do: Callable[[A], B],
    jobs: Sequence[A],
    workers: int,
    keep: Callable[[A, B], None],
    lost: Callable[[A], B] | None = None,
) -> None:
    """`keep` every job with its result, in the order in which they end; one worker is this process.

    A job during which its process died is done once more by itself; where that process dies too, its
    result is that of `lost`, or the error is raised. Ctrl-C lets jobs under way end, keeps them, and is
    raised again.
    """
    if workers == 1 or not jobs:
        with threadpool_limits(1, "blas"):
            for job in jobs:
                keep(job, do(job))
        return
    left, suspects = deque(jobs), deque[A]()
    while left or suspects:
        if left:
            suspects.extend(_until_one_dies(do, left, min(workers, len(jobs)), _AHEAD, keep))
            continue
        for job in _until_one_dies(do, suspects, 1, 1, keep):
            if lost is None:
                raise BrokenProcessPool(f"a process ended while it was at {job}")
            keep(job, lost(job))


def _until_one_dies(
    do: Callable[[A], B], left: deque[A], workers: int, ahead: int, keep: Callable[[A, B], None]
) -> list[A]:
    """Take jobs from the left until none are left, or until a process dies: those it may have died of."""
    under_way: dict[Future[B], A] = {}

    def take_in(done: Future[B]) -> bool:
        try:
            result = done.result()
        except BrokenProcessPool:
            return False
        keep(under_way.pop(done), result)
        return True

    context = get_context("spawn")
    with ProcessPoolExecutor(workers, context, initializer=alone_in, initargs=(os.getpid(),)) as pool:
        try:
            while left or under_way:
                while left and len(under_way) < ahead * workers:
                    # A process that this begins is deaf to Ctrl-C before it can say so itself.
                    with held_back():
                        under_way[pool.submit(do, left[0])] = left[0]
                    left.popleft()
                done = wait(under_way, return_when=FIRST_COMPLETED).done
                if sum(map(take_in, done)) < len(done):
                    return list(under_way.values())
        except BrokenProcessPool:
            return list(under_way.values())
        except BaseException as stop:
            pool.shutdown(wait=True, cancel_futures=True)
            if isinstance(stop, KeyboardInterrupt):
                _keep_what_ended(under_way, take_in)
            raise
    return []


def _keep_what_ended(under_way: dict[Future[Any], Any], take_in: Callable[[Future[Any]], bool]) -> None:
    for one in list(under_way):
        if not one.cancelled():
            with suppress(Exception):
                take_in(one)


def alone_in(parent: int) -> None:
    """Make this a worker: one process, one BLAS thread, deaf to Ctrl-C, which the parent hears."""
    end_with(parent)
    os.environ[PROCESSES] = "1"
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threadpool_limits(1, "blas")
