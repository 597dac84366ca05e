"""Tables of any program's text: commas, semicolons, tabs or blanks; units in names or in their own row."""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from instrument.errors import BadInput
from instrument.files.modal_table import read_said
from instrument.files.sweep_file import reading_said
from instrument.files.table import Rows, check_size, rate_stated_in, shown
from instrument.interchange.celsius import is_temperature
from instrument.interchange.decoded import decoded
from instrument.interchange.found import CARRIED, EXPECTED, Found
from instrument.interchange.naming import Naming
from instrument.interchange.read_table import read_table
from instrument.interchange.said_by_name import NotSaid
from instrument.interchange.signals import Named
from instrument.interchange.text_table import TextTable, find_table, is_number, number_of
from instrument.interchange.unit_in_name import part_in, unit_in

_PARTED = re.compile(r"[-+]?[1-9]\d{0,2}(?:[.,]\d{3})+")
_HUNDREDS = re.compile(r"[-+]?[1-9]\d\d")
_MARKED = re.compile(r"[-+]?\d[\d.,]*(?:[eE][-+]?\d+)?")


def read_csv(path: Path, naming: Naming | None = None) -> Found:
    """The table's sweep, FRF or record; `naming` has names in the place of the file's own.

    Raises `BadInput` naming file and line.
    """
    text = decoded(path)
    found, stands = Found(), find_table(path, text, naming)
    table = _numbers(path, stands)
    found.reads = reading_said(text.splitlines()[: stands.rows[0][0] - 1])
    rate = rate_stated_in(path, text)
    if rate is not None:
        table["sample_rate_hz"] = np.array([rate])
    found.said += [f"{path.name}: {line}" for line in stands.said]
    words = [name for name in stands.names if name not in ("", "-") and name not in table]
    if words:
        found.said.append(f"passed over: {path.name}: {', '.join(words)[:200]}: no numbers")
    found.lines = [] if "hit" in table else [line for line, _ in stands.rows]
    for name, part in _hits_apart(path, table):
        try:
            is_known = read_table(name, part, found)
        except FloatingPointError:
            _refuse_infinite(path, table, found)
            raise
        if not is_known:
            raise NotSaid(_nothing(path, stands.names))
    if found.modes:
        read = read_said(path, text)
        found.modes = [replace(one, read=one.read or read) for one in found.modes]
    return found


def _refuse_infinite(path: Path, table: Named, found: Found) -> None:
    """Raise `BadInput` for the first cell that is no finite number, of columns with units before others."""
    for name, values in sorted(table.items(), key=lambda column: unit_in(column[0]) is None):
        for k in np.flatnonzero(np.isinf(values)):
            check_size(f"{path}: {found.place(int(k), len(values))}", name, values[k], f"{values[k]:g}")


def _nothing(path: Path, names: Sequence[str]) -> str:
    return f"{path}: header: found {', '.join(names)[:100]}, expected {EXPECTED}; and two rows or more"


def _hits_apart(path: Path, table: Named) -> list[tuple[str, Named]]:
    """Where hits share a file each is a table of its own."""
    if "hit" not in table:
        return [(path.name, table)]
    which = table["hit"]
    return [
        (
            f"{path.name} hit {n:g}",
            {k: v[which == n] if v.shape == which.shape else v for k, v in table.items()},
        )
        for n in np.unique(which)
    ]


def _numbers(path: Path, stands: TextTable) -> Named:
    """Columns of numbers; one of none, or of some and without a unit in its name, is text and passed over."""
    names, rows, comma = stands.names, stands.rows, stands.separator != ","
    _check_marks(path, rows, comma=comma)
    _check_thousands(path, names, rows)

    def is_numeric(k: int, name: str) -> bool:
        if unit_in(name) is not None or part_in(name) == "phase" or _may_lack(name):
            return any(is_number(row[k], comma=comma) for _, row in rows)
        return is_number(rows[0][1][k], comma=comma)

    numeric = [k for k, name in enumerate(names) if name and name != "-" and is_numeric(k, name)]
    return {
        names[k]: _real(
            np.array([_number(path, line, _cell(names[k], row[k]), comma=comma) for line, row in rows])
        )
        for k in numeric
    }


def _cell(name: str, text: str) -> str:
    """Nothing is "not known" where a column need not say something of every row."""
    return text or ("nan" if _may_lack(name) else "")


def _may_lack(name: str) -> bool:
    return name in CARRIED or is_temperature(name)


def _real(values: NDArray[np.complex128]) -> NDArray[Any]:
    """The same without imaginary parts that are none anywhere."""
    return values if np.iscomplexobj(values) and np.any(values.imag) else np.asarray(values.real)


def _check_thousands(path: Path, names: Sequence[str], rows: Rows) -> None:
    """Raise `BadInput` for a column that goes on from 999 to 1.000: there the mark parts thousands."""
    for k, name in enumerate(names):
        column = [(line, row[k]) for line, row in rows if k < len(row)]
        marked = [(line, text) for line, text in column if "." in text or "," in text]
        hundreds = any(_HUNDREDS.fullmatch(text) for _, text in column)
        if hundreds and marked and all(_PARTED.fullmatch(text) for _, text in marked):
            line, text = marked[0]
            raise BadInput(
                f"{path}: line {line}: {name} = {text!r} beside whole numbers: a mark between thousands?"
            )


def _check_marks(path: Path, rows: Rows, *, comma: bool) -> None:
    """Raise `BadInput` where commas and points stand in a file's numbers: one of them parts thousands.

    Without `comma` they part columns, and none may stand within a number.
    """
    fields = [(line, field) for line, row in rows for field in row if _MARKED.fullmatch(field)]
    points = [field for _, field in fields if "." in field]
    for line, field in fields:
        if "," in field and not comma:
            raise BadInput(
                f"{path}: line {line}: {field!r} where commas are between columns, expected a decimal point"
            )
        if "," in field and points:
            raise BadInput(
                f"{path}: line {line}: {field!r} beside {points[0]!r}, expected one decimal mark, and none "
                "between thousands"
            )


def _number(path: Path, line: int, text: str, *, comma: bool) -> complex:
    if not is_number(text, comma=comma):
        raise BadInput(f"{path}: line {line}: {shown(text)!r}, expected a number")
    return number_of(text, comma=comma)
