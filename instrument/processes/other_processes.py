"""Other processes that take their share of a diagnosis.

The fits are many small steps that hold Python's lock, so threads gain nothing.
"""

import os
import signal
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, contextmanager, nullcontext
from threading import Thread
from time import sleep
from types import TracebackType
from typing import Any
from weakref import WeakSet

from loky import ProcessPoolExecutor

from fitting.diagnosis.executor import ALONE, Call, Executor
from fitting.progress import Report, unheard
from instrument.errors import BadInput
from instrument.processes.background import step_back
from instrument.processes.terminal_signals import BY_A_PERSON

VARIABLE = "VISCORIG_PROCESSES"
_MOST_PROCESSES = 4
"""Processes of a diagnosis: it goes from one step to the next, and a fifth would mostly wait."""
_LOOKS_ROUND_S = 1.0
"""How often another process asks whether the first one is still there."""
_begun: "WeakSet[SeveralProcesses]" = WeakSet()
"""Those that have not been ended, for whoever gives up what they work on."""


def processors() -> int:
    """Those that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def wanted(most: int | None = None) -> int:
    """How many processes to take: as `VISCORIG_PROCESSES` says, or one for each processor, `most` at most.

    Raises `BadInput` where that is no number of processes.
    """
    said = os.environ.get(VARIABLE, "").strip()
    if not said:
        return processors() if most is None else min(processors(), most)
    if not said.isdecimal() or int(said) < 1:
        raise BadInput(f"{VARIABLE} is {said!r}, not a number of processes")
    return int(said)


def executor() -> AbstractContextManager[Executor]:
    """Of a diagnosis: as many processes as are wanted. Raises as `wanted`."""
    others = wanted(_MOST_PROCESSES) - 1
    return SeveralProcesses(others) if others else nullcontext(ALONE)


def end_all() -> None:
    """End the other processes of every diagnosis: given up, it would be waited for when this process ends."""
    for several in list(_begun):
        several.end()


class SeveralProcesses(Executor):
    """Others beside this one; a context manager. They begin to load at once."""

    def __init__(self, others: int) -> None:
        self._others = [_Other() for _ in range(others)]
        _begun.add(self)

    def __enter__(self) -> "SeveralProcesses":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.end()

    def end(self) -> None:
        """End them at once, whatever they are at; also twice."""
        _begun.discard(self)
        for other in self._others:
            other.end()

    def together(self, calls: Sequence[Call], report: Report = unheard) -> Iterator[Any]:
        """Results of the calls in their order; the methods' own object is sent once to each process."""
        left = deque(enumerate(calls))
        found: dict[int, Any] = {}
        failed: list[Exception] = []

        def beside(other: _Other) -> None:
            while left and not failed:
                try:
                    k, call = left.popleft()
                except IndexError:
                    return
                try:
                    found[k] = other.asked(call)
                except BrokenProcessPool:
                    left.append((k, call))
                    return
                except Exception as error:  # raised where it is waited for
                    failed.append(error)

        asking = [
            Thread(target=beside, args=(other,), name="another process", daemon=True)
            for other in self._others[: len(calls) - 1]
        ]
        for thread in asking:
            thread.start()
        while left or any(thread.is_alive() for thread in asking):
            try:
                k, (do, arguments) = left.popleft()
            except IndexError:
                for thread in asking:
                    thread.join()
                continue
            found[k] = do(*arguments)
            report(len(found) / len(calls))
        if failed:
            raise failed[0]
        report(1.0)
        yield from (found[k] for k in range(len(calls)))


@contextmanager
def held_back() -> Iterator[None]:
    """No Ctrl-C reaches this thread, nor the processes and threads that begin here; other threads hear it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    from multiprocessing import resource_tracker

    # It comes with the first process, and its start lets a Ctrl-C through again.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, BY_A_PERSON)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class _Other:
    """One process, and what it knows."""

    def __init__(self) -> None:
        self.pool = ProcessPoolExecutor(
            1, initializer=_begin, initargs=(os.getpid(),), env={"OPENBLAS_NUM_THREADS": "1"}
        )
        # Another process begins with the signals held back that this thread holds back: `_begin` is too late.
        with held_back():
            self.pool.submit(_nothing)
        self._known: object = None
        self._number = 0
        """Of objects sent over so far."""

    def end(self) -> None:
        self.pool.shutdown(wait=True, kill_workers=True)

    def asked(self, call: Call) -> Any:
        do, arguments = call
        owner: object = do.__self__  # type: ignore[attr-defined]
        if owner is not self._known:
            self._known, self._number = owner, self._number + 1
            self.pool.submit(learn, self._number, owner)
        found = self.pool.submit(_do, self._number, do.__name__, arguments).result()
        if isinstance(found, _Forgotten):
            # loky replaces a process whose memory has grown; the new one knows nothing.
            self._known = None
            return self.asked(call)
        return found


# In another process.

_owner: Any = None
_number = 0


def _begin(first: int) -> None:
    # Ctrl-C is for the first process, which ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    step_back()
    end_with(first)
    import fitting.effects  # noqa: F401


def end_with(first: int) -> None:
    """End this process soon after its parent, whose number is given: if that is killed, nobody else would."""
    Thread(target=_end_after, args=(first,), daemon=True).start()


def _end_after(first: int) -> None:
    while os.getppid() == first:
        sleep(_LOOKS_ROUND_S)
    os._exit(0)


def _nothing() -> None:
    pass


class _Forgotten:
    """Answer of a process that does not have the object it is asked of."""


def learn(number: int, owner: object) -> None:
    """Keep what this process is asked of from now on, and which of the objects sent over it is."""
    global _owner, _number
    _owner, _number = owner, number


def _do(number: int, name: str, arguments: tuple[object, ...]) -> object:
    return getattr(_owner, name)(*arguments) if number == _number else _Forgotten()
