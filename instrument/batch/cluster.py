"""The rows of a batch on a Dask scheduler that somebody else started. Files lie where every worker sees them.

Dask does again what a worker had under way when it was lost.
"""

from collections.abc import Callable, Sequence
from typing import Any

from instrument.batch.keys import program
from instrument.batch.task import Task
from instrument.batch.work import Outcome, failure, outcome_of
from instrument.errors import BadInput

_AHEAD, _LEAST_AHEAD = 3, 16
"""Rows handed out for each thread of the cluster; at least so many, for one that is still growing."""
_TIMEOUT_S = 20


def on_cluster(address: str, tasks: Sequence[Task], keep: Callable[[Task, Outcome], None]) -> None:
    """`keep` every task with its outcome, in the order in which they end. Raises `BadInput`."""
    try:
        from distributed import Client
    except ImportError:
        raise BadInput("--scheduler: no Dask here, expected pip install 'viscorig[cluster]'") from None
    try:
        client = Client(address, timeout=_TIMEOUT_S, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        said = " ".join(str(error).split())[:120]
        raise BadInput(f"--scheduler {address}: no Dask scheduler answers there ({said})") from None
    with client:
        _hand_out(client, tasks, keep)


def _hand_out(client: Any, tasks: Sequence[Task], keep: Callable[[Task, Outcome], None]) -> None:
    """Few enough at a time that neither the scheduler nor this program holds many."""
    from distributed import as_completed

    left, under_way = list(reversed(tasks)), dict[str, Task]()
    ended = as_completed([], loop=client.loop)

    def fill() -> None:
        most = max(_LEAST_AHEAD, _AHEAD * sum(client.nthreads().values()))
        while left and len(under_way) < most:
            task = left.pop()
            future = client.submit(outcome_of, task, pure=False)
            under_way[future.key] = task
            ended.add(future)

    fill()
    for future in ended:
        task = under_way.pop(future.key)
        keep(task, _outcome(future))
        fill()


def _outcome(future: Any) -> Outcome:
    error = future.exception()
    if isinstance(error, ImportError):
        raise BadInput(f"--scheduler: a worker cannot do this: {error}, expected viscorig on every worker")
    if error is not None:
        # A row never raises by itself: its workers were lost, more often than Dask puts up with.
        return {**failure(f"{type(error).__name__}: {error}", again=True), "program": program()}
    outcome: Outcome = future.result()
    if outcome["program"] != program():
        raise BadInput(
            f"--scheduler: a worker has another program ({outcome['program']}), expected {program()}"
        )
    return outcome
