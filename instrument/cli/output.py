"""What a command prints: a table for people, the same facts as JSON."""

import json
import math
import os
import sys
from contextlib import suppress
from pathlib import Path

import click
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from instrument.cli.printable import printable
from instrument.errors import BadInput
from instrument.facts.result import Result


class _Screen(Console):
    """Falls silent where its reader has gone; the command goes on, for its files are still wanted."""

    def on_broken_pipe(self) -> None:
        """Instead of rich's, which ends the program."""
        self.quiet = True
        with suppress(OSError, ValueError), open(os.devnull, "wb") as nowhere:
            # What is left in the buffer goes there, or Python complains at exit.
            os.dup2(nowhere.fileno(), sys.stdout.fileno())


class Output:
    """Where a command's results go, as `--json` decides."""

    def __init__(self, json_path: str | None) -> None:
        self._json_path = json_path
        if json_path not in (None, "-") and not Path(str(json_path)).parent.is_dir():
            # Said before the work, not after it.
            raise BadInput(f"{json_path}: no such folder to write to")
        self._console = _Screen(highlight=False, quiet=json_path == "-", soft_wrap=True)

    def say(self, text: str = "") -> None:
        """A line for people."""
        self._console.print(printable(text), markup=False)

    def table(self, title: str, columns: list[str], rows: list[list[str]]) -> None:
        """A table for people, numbers to the right."""
        table = Table(box=None, pad_edge=False)
        if title:
            # Not as the table's own title: that would be wrapped to the table's width.
            self._console.print(printable(title), style="bold", markup=False)
        for k, column in enumerate(columns):
            table.add_column(column, justify="left" if k == 0 and not _numeric(rows, k) else "right")
        for row in rows:
            table.add_row(*(escape(printable(cell)) for cell in row))
        _Screen(highlight=False, quiet=self._console.quiet, width=max(self._console.width, 120)).print(table)

    def result(self, found: Result) -> None:
        """The facts as JSON, where they were asked for.

        Raises `BadInput` where the file cannot be written.
        """
        if self._json_path is None:
            return
        text = json.dumps(found.as_json(), indent=1, allow_nan=False)
        if self._json_path == "-":
            click.echo(text)
            return
        try:
            Path(self._json_path).write_text(text + "\n", encoding="utf-8")
        except OSError as error:
            raise BadInput(f"{self._json_path}: {error.strerror or error}") from None


def _numeric(rows: list[list[str]], column: int) -> bool:
    try:
        return all(math.isfinite(float(row[column])) for row in rows)
    except ValueError:
        return False
