"""Progress of long work: a bar on a terminal, nothing in a pipe."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from rich.console import Console
from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
from rich.progress import Progress as Bars

Report = Callable[[float], None]
"""Told the fraction done, 0 to 1."""
Progress = Callable[[str], AbstractContextManager[Report]]
"""Opens a piece of work by its name."""


@contextmanager
def quiet(name: str) -> Iterator[Report]:
    """No progress shown."""
    yield lambda fraction: None


@contextmanager
def bar(name: str) -> Iterator[Report]:
    """A bar on standard error where that is a terminal."""
    console = Console(stderr=True)
    with Bars(
        TextColumn("{task.description}"),
        BarColumn(),
        TimeElapsedColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    ) as bars:
        task = bars.add_task(name, total=1.0)
        yield lambda fraction: bars.update(task, completed=fraction)
