"""A second process that takes half of a diagnosis.

The fits are many small steps that hold Python's lock, so threads gain nothing.
"""

import os
import signal
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, nullcontext
from threading import Thread
from time import sleep
from types import TracebackType
from typing import Any

from loky import ProcessPoolExecutor

from fitting.diagnosis.executor import ALONE, Call, Executor, Report
from instrument.models.background import step_back

VARIABLE = "VISCORIG_PROCESSES"
_LOOKS_ROUND_S = 1.0
"""How often the second process asks whether the first one is still there."""


def processors() -> int:
    """Those that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def executor() -> AbstractContextManager[Executor]:
    """Two where the machine has two processors, unless `VISCORIG_PROCESSES` is 1."""
    if processors() < 2 or os.environ.get(VARIABLE) == "1":
        return nullcontext(ALONE)
    return TwoProcesses()


class TwoProcesses(Executor):
    """A second process beside this one; a context manager. It begins to load at once."""

    def __init__(self) -> None:
        self._other = ProcessPoolExecutor(
            1, initializer=_begin, initargs=(os.getpid(),), env={"OPENBLAS_NUM_THREADS": "1"}
        )
        self._other.submit(_nothing)
        self._known: object = None
        self._number = 0
        """Of objects sent over so far."""

    def __enter__(self) -> "TwoProcesses":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._other.shutdown(wait=True, kill_workers=True)

    def together(self, calls: Sequence[Call], report: Report = lambda fraction: None) -> Iterator[Any]:
        """The same, the methods' own object sent over once."""
        left = deque(enumerate(calls))
        found: dict[int, Any] = {}
        failed: list[Exception] = []

        def beside() -> None:
            while left and not failed:
                try:
                    k, call = left.popleft()
                except IndexError:
                    return
                try:
                    found[k] = self._elsewhere(*call)
                except BrokenProcessPool:
                    left.append((k, call))
                    return
                except Exception as error:  # raised where it is waited for
                    failed.append(error)

        thread = Thread(target=beside, name="second process", daemon=True)
        thread.start()
        while left or thread.is_alive():
            try:
                k, (do, one) = left.popleft()
            except IndexError:
                thread.join()
                continue
            found[k] = do(one)
            report(len(found) / len(calls))
        if failed:
            raise failed[0]
        report(1.0)
        yield from (found[k] for k in range(len(calls)))

    def _elsewhere(self, do: Callable[[Any], Any], one: Any) -> Any:
        owner: object = do.__self__  # type: ignore[attr-defined]
        if owner is not self._known:
            self._known, self._number = owner, self._number + 1
            self._other.submit(_learn, self._number, owner)
        found = self._other.submit(_do, self._number, do.__name__, one).result()
        if isinstance(found, _Forgotten):
            # loky replaces a process whose memory has grown; the new one knows nothing.
            self._known = None
            return self._elsewhere(do, one)
        return found


# In the second process.

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


def _learn(number: int, owner: object) -> None:
    global _owner, _number
    _owner, _number = owner, number


def _do(number: int, name: str, one: object) -> object:
    return getattr(_owner, name)(one) if number == _number else _Forgotten()
