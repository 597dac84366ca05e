"""A batch from its question to its table: what is known is not done again, what is found is kept at once."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from instrument.batch.cluster import run_on_cluster
from instrument.batch.families import with_families
from instrument.batch.journal import OutcomeJournal
from instrument.batch.keys import Keys
from instrument.batch.task import BatchTask
from instrument.batch.work import Outcome, failure, lost, outcome_of
from instrument.errors import BadInput, StoppedByUser, system_words
from instrument.files.text import refuse_endless
from instrument.processes.jobs import in_processes
from instrument.progress import Progress, quiet

Keep = Callable[[BatchTask, Outcome], None]
Runner = Callable[[Sequence[BatchTask], Keep], None]


def here(workers: int) -> Runner:
    """In processes of this machine."""
    return lambda tasks, keep: in_processes(outcome_of, tasks, workers, keep, lost)


def on_cluster(address: str) -> Runner:
    """On a Dask scheduler."""
    return partial(run_on_cluster, address)


@dataclass(frozen=True)
class BatchRow:
    """A task and what came of it."""

    task: BatchTask
    outcome: Outcome
    contents: str | None = None
    """Digest of its data; None where they cannot be read."""


class Rows:
    """All rows in the order of the question, one at a time from the disk; a context."""

    def __init__(
        self,
        tasks: Sequence[BatchTask],
        keys: Sequence[str | None],
        contents: Sequence[str | None],
        journal: OutcomeJournal,
    ) -> None:
        self._tasks, self._keys, self._contents, self._journal = tasks, keys, contents, journal
        self.repeated = 0
        """How many the journal had already."""

    def __len__(self) -> int:
        return len(self._tasks)

    def __iter__(self) -> Iterator[BatchRow]:
        for task, key, contents in zip(self._tasks, self._keys, self._contents, strict=True):
            if key is not None and key in self._journal:
                yield BatchRow(task, self._journal[key], contents)
            else:
                yield BatchRow(task, _unread(task), contents)

    def __enter__(self) -> "Rows":
        return self

    def __exit__(self, *_: object) -> None:
        self._journal.__exit__(None, None, None)


def run_batch(
    tasks: Sequence[BatchTask], folder: Path, runner: Runner | None = None, progress: Progress = quiet
) -> Rows:
    """Do what is not done yet. Raises `BadInput`, `StoppedByUser`."""
    tasks = with_families(tasks)
    journal = OutcomeJournal(folder)
    try:
        with progress("looking for what is done"):
            keyed = Keys()
            keys = [keyed.key(task) for task in tasks]
            contents = [keyed.contents(task) for task in tasks]
        known = {key for key in keys if key in journal}
        _do_what_is_left(tasks, keys, journal, runner or here(1), progress)
    except BaseException:
        journal.__exit__(None, None, None)
        raise
    rows = Rows(tasks, keys, contents, journal)
    rows.repeated = sum(key in known for key in keys)
    return rows


def _do_what_is_left(
    tasks: Sequence[BatchTask],
    keys: Sequence[str | None],
    journal: OutcomeJournal,
    runner: Runner,
    progress: Progress,
) -> None:
    """Rows of one key are done once."""
    left = {key: task for task, key in zip(tasks, keys, strict=True) if key and key not in journal}
    by_task = {task: key for key, task in left.items()}
    count, done = len(tasks), len(tasks) - len(left)
    # Not what is tried again: a file that cannot be read, a row that failed for a reason outside itself.
    settled = {key for key in keys if key is not None and key in journal}
    with progress(f"{count} rows") as report:
        report(done / count if count else 1.0)

        def keep(task: BatchTask, outcome: Outcome) -> None:
            nonlocal done
            journal.keep(by_task[task], outcome)
            if not outcome["again"]:
                settled.add(by_task[task])
            done += 1
            report(done / count)

        try:
            runner(list(by_task), keep)
        except KeyboardInterrupt:
            kept = sum(key in settled for key in keys)
            said = f"{kept} of {count} rows done, kept in {journal.path}; the same command goes on"
            raise StoppedByUser(said) from None


def _unread(task: BatchTask) -> Outcome:
    """Of a row that names a file which cannot be read."""
    for what, path in (("", task.data), ("specimen ", task.specimen), ("hammer test ", task.hammer)):
        if path is not None:
            # The row itself names its data.
            name = f"{what}{Path(path).name or path}: " if what else ""
            try:
                refuse_endless(Path(path))
                with open(path, "rb") as file:
                    file.read(1)
            except BadInput as error:
                return failure(name + str(error).removeprefix(f"{path}: "), again=True)
            except OSError as error:
                return failure(name + system_words(error), again=True)
    return failure("its files changed while the batch went on", again=True)
