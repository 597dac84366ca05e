"""What a command prints: a table for people, the same facts as JSON."""

import math
from pathlib import Path

import click
from rich.markup import escape
from rich.table import Table

from instrument.cli.printable import printable
from instrument.errors import BadInput
from instrument.facts.result import Result
from instrument.files.at_once import refuse_unwritable
from instrument.files.replaceable import refuse_another_json, refuse_for_json
from instrument.files.result_file import result_text, write_result
from instrument.progress import Screen

_WRITTEN = ("json_path", "out", "pdf")
"""Parameters of commands that name files to be written."""
_FIGURES = "figures"
"""And the one that names a folder for such files."""


def _keep_what_is_read() -> None:
    """No file that the command reads is written over. Raises `BadInput`."""
    context = click.get_current_context(silent=True)
    given = context.params if context is not None else {}
    written = [Path(str(given[name])) for name in _WRITTEN if given.get(name) is not None]
    values = [value for name, value in given.items() if name not in _WRITTEN]
    read = [one for value in values for one in (value if isinstance(value, tuple) else (value,))]
    for path in written:
        if path.is_file() and any(isinstance(r, Path) and r.is_file() and path.samefile(r) for r in read):
            raise BadInput(f"{path}: read by this command, expected another name for what it writes")


def _refuse_unwritable() -> None:
    """Raise `BadInput` for what could not be written in the end."""
    context = click.get_current_context(silent=True)
    given = context.params if context is not None else {}
    for name in (*_WRITTEN, _FIGURES):
        if given.get(name) not in (None, "-", Path("-")):
            refuse_unwritable(Path(str(given[name])))


class Output:
    """Where a command's results go, as `--json` decides."""

    def __init__(self, json_path: str | None) -> None:
        self._json_path = json_path
        if json_path not in (None, "-") and not Path(str(json_path)).parent.is_dir():
            # Said before the work, not after it.
            raise BadInput(f"{json_path}: no such folder to write to")
        if json_path is not None and Path(json_path).is_dir():
            raise BadInput(f"{json_path}: is a folder, expected a file to write to")
        _keep_what_is_read()
        if json_path not in (None, "-"):
            refuse_for_json(Path(str(json_path)))
            refuse_another_json(Path(str(json_path)))
        _refuse_unwritable()
        self._console = Screen(highlight=False, quiet=json_path == "-", soft_wrap=True)

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
        Screen(highlight=False, quiet=self._console.quiet, width=max(self._console.width, 120)).print(table)

    def result(self, found: Result) -> None:
        """The facts as JSON, where they were asked for.

        Raises `BadInput` where the file cannot be written.
        """
        if self._json_path is None:
            return
        if self._json_path == "-":
            click.echo(result_text(found))
            return
        write_result(Path(self._json_path), found)


def _numeric(rows: list[list[str]], column: int) -> bool:
    try:
        return all(math.isfinite(float(row[column])) for row in rows)
    except ValueError:
        return False
