"""The rows of a batch on a Dask scheduler that somebody else started. Files lie where every worker sees them.

Dask does again what a worker had under way when it was lost.
"""

import re
from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Any

from instrument.batch.keys import program
from instrument.batch.task import BatchTask
from instrument.batch.work import Outcome, failure, outcome_of
from instrument.errors import BadInput

_AHEAD = 3
"""Bundles handed out for each thread of the cluster: it never waits for this program."""
_LEAST_AHEAD = 16
"""Rows handed out at least, for a cluster that is still growing."""
_BUNDLE_S, _MOST_IN_A_BUNDLE = 1.0, 8
"""Short rows travel together: a journey costs scheduler and program some milliseconds, a small sweep 50."""
_TIMEOUT_S = 20
_ADDRESS = re.compile(r"(?:\w+://)?[^\s/]+:\d+/?")
"""Asked of anything else, Dask waits, and says so by a traceback."""


def run_on_cluster(
    address: str, tasks: Sequence[BatchTask], keep: Callable[[BatchTask, Outcome], None]
) -> None:
    """`keep` every task with its outcome, in the order in which they end. Raises `BadInput`."""
    try:
        from distributed import Client
    except ImportError:
        raise BadInput("--scheduler: no Dask here, expected pip install 'viscorig[cluster]'") from None
    if _ADDRESS.fullmatch(address) is None:
        raise BadInput(f"--scheduler {address}: no address, expected as in tcp://host:8786")
    try:
        client = Client(address, timeout=_TIMEOUT_S, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        said = " ".join(str(error).split())[:120]
        raise BadInput(f"--scheduler {address}: no Dask scheduler answers there ({said})") from None
    with client:
        _hand_out(client, tasks, keep)


def outcomes_of(tasks: Sequence[BatchTask]) -> tuple[list[Outcome], float]:
    """What a worker does with a bundle, and the seconds that it took."""
    began = perf_counter()
    return [outcome_of(task) for task in tasks], perf_counter() - began


class Bundles:
    """The rows still to be handed out: short ones together, one that may have ended its worker alone."""

    def __init__(self, tasks: Sequence[BatchTask]) -> None:
        self._left = list(reversed(tasks))
        self._alone: list[BatchTask] = []
        self._row_s: float | None = None

    def __bool__(self) -> bool:
        return bool(self._left or self._alone)

    def next(self, threads: int) -> list[BatchTask]:
        """About a second's work; one row until it is known how long they take, and where few are left."""
        if self._alone:
            return [self._alone.pop()]
        by_time = 1 if self._row_s is None else int(_BUNDLE_S / self._row_s)
        share = len(self._left) // (2 * _AHEAD * threads)
        return [self._left.pop() for _ in range(max(1, min(by_time, share, _MOST_IN_A_BUNDLE)))]

    def took(self, rows: int, seconds: float) -> None:
        """A bundle's time. A slow one counts at once, a quick one by half: rows are alike by stretches."""
        row_s = max(seconds / rows, 1e-3)
        self._row_s = row_s if self._row_s is None else max(row_s, (self._row_s + row_s) / 2)

    def again(self, tasks: Sequence[BatchTask]) -> None:
        """Hand these out once more, each alone."""
        self._alone.extend(tasks)


def _hand_out(client: Any, tasks: Sequence[BatchTask], keep: Callable[[BatchTask, Outcome], None]) -> None:
    """Few enough at a time that neither the scheduler nor this program holds many."""
    from distributed import as_completed

    bundles, under_way = Bundles(tasks), dict[str, list[BatchTask]]()
    ended = as_completed([], loop=client.loop)

    def fill() -> None:
        threads = max(1, sum(client.nthreads().values()))
        while bundles and (
            len(under_way) < _AHEAD * threads or sum(map(len, under_way.values())) < _LEAST_AHEAD
        ):
            bundle = bundles.next(threads)
            future = client.submit(outcomes_of, bundle, pure=False)
            under_way[future.key] = bundle
            ended.add(future)

    fill()
    for future in ended:
        bundle = under_way.pop(future.key)
        outcomes, seconds = _of(future)
        if outcomes is not None:
            bundles.took(len(bundle), seconds)
            for task, outcome in zip(bundle, outcomes, strict=True):
                keep(task, outcome)
        elif len(bundle) > 1:
            bundles.again(bundle)
        else:
            keep(bundle[0], _lost(future))
        fill()


def _of(future: Any) -> tuple[list[Outcome] | None, float]:
    """What came of a bundle, None where its workers were lost. Raises `BadInput`."""
    error = future.exception()
    if isinstance(error, ImportError):
        raise BadInput(f"--scheduler: a worker cannot do this: {error}, expected viscorig on every worker")
    if error is not None:
        return None, 0.0
    outcomes, seconds = future.result()
    for outcome in outcomes:
        if outcome["program"] != program():
            raise BadInput(
                f"--scheduler: a worker has another program ({outcome['program']}), expected {program()}"
            )
    return outcomes, seconds


def _lost(future: Any) -> Outcome:
    """A row never raises by itself: its workers were lost, more often than Dask puts up with."""
    error = future.exception()
    return {**failure(f"{type(error).__name__}: {error}", again=True), "program": program()}
