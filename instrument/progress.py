"""Progress of long work: a bar on a terminal, nothing in a pipe, lines of JSON for a program that asks."""

import errno
import json
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.progress import Progress as Bars

from fitting.progress import Report

Progress = Callable[[str], AbstractContextManager[Report]]
"""Opens a piece of work by its name."""
LINES = "VISCORIG_PROGRESS"
"""Where this variable of the environment is `lines`, a bar is told as lines on standard error."""
_LEAST_STEP = 0.01
_PACE_S = 300.0
"""Over which the pace is taken that says how long it will go on."""


class Screen(Console):
    """Falls silent where its reader has gone, a program or a terminal; the command goes on.

    Its files are still wanted.
    """

    def __exit__(self, *raised: Any) -> None:
        try:
            super().__exit__(*raised)
        except OSError as error:
            # What a terminal says that is no more; a closed pipe rich hears of itself.
            if error.errno != errno.EIO:
                raise
            self.on_broken_pipe()

    def on_broken_pipe(self) -> None:
        """Instead of rich's, which ends the program."""
        self.quiet = True
        with suppress(OSError, ValueError), open(os.devnull, "wb") as nowhere:
            # What is left in the buffer goes there, or Python complains at exit.
            os.dup2(nowhere.fileno(), (sys.stderr if self.stderr else sys.stdout).fileno())


@contextmanager
def quiet(name: str) -> Iterator[Report]:
    """No progress shown."""
    yield lambda fraction: None


@contextmanager
def bar(name: str) -> Iterator[Report]:
    """A bar on standard error where that is a terminal."""
    if os.environ.get(LINES) == "lines":
        yield _Lines(name)
        return
    console = Screen(stderr=True)
    with Bars(
        TextColumn("{task.description}"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        speed_estimate_period=_PACE_S,
        console=console,
        transient=True,
        disable=not console.is_terminal,
    ) as bars:
        task = bars.add_task(name, total=1.0)
        yield lambda fraction: bars.update(task, completed=fraction)


class _Lines:
    """One line a hundredth."""

    def __init__(self, name: str) -> None:
        self._name, self._said = name, -1.0

    def __call__(self, fraction: float) -> None:
        if abs(fraction - self._said) >= _LEAST_STEP:
            self._said = fraction
            print(json.dumps({"work": self._name, "fraction": fraction}), file=sys.stderr, flush=True)
