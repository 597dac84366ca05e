"""Rows of a CSV with their line numbers: comma-separated, `#` comments, one header."""

import csv
import math
from collections.abc import Callable, Iterator
from pathlib import Path

from instrument.errors import BadInput
from instrument.files.text import read_text

Rows = list[tuple[int, list[str]]]


def read_rows(path: Path, check_header: Callable[[list[str]], None]) -> tuple[list[str], Rows]:
    """The header, checked by `check_header`, and the rows with their line numbers, all equally long."""
    header: list[str] | None = None
    rows: Rows = []
    for line, row in _fields(path):
        if header is None:
            header = row
            for name in header:
                if name and header.count(name) > 1:
                    raise BadInput(f"{path}: header: column {name} twice")
            check_header(header)
            continue
        if len(row) != len(header):
            raise BadInput(
                f"{path}: line {line}: {len(row)} columns, expected {len(header)} as in the header"
            )
        rows.append((line, row))
    if header is None:
        raise BadInput(f"{path}: no header, expected a line of column names")
    if not rows:
        raise BadInput(f"{path}: no rows below the header")
    return header, rows


def number(path: Path, line: int, name: str, text: str) -> float:
    """A finite number, or one line saying where it is not."""
    try:
        value = float(text)
    except ValueError:
        raise BadInput(f"{path}: line {line}: {name} = {text!r}, expected a number") from None
    if not math.isfinite(value):
        raise BadInput(f"{path}: line {line}: {name} = {text}, expected a finite number")
    return value


def _fields(path: Path) -> Iterator[tuple[int, list[str]]]:
    for line, text in enumerate(read_text(path).splitlines(), start=1):
        if text.strip() and not text.lstrip().startswith("#"):
            try:
                yield line, [field.strip() for field in next(csv.reader([text], strict=True))]
            except csv.Error as error:
                raise BadInput(f"{path}: line {line}: {error}") from None
