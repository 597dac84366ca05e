"""CSV of any origin: comma, semicolon or tab; decimal comma; units in the names or in a row of their own."""

import re
from pathlib import Path

import numpy as np

from instrument.errors import BadInput
from instrument.files.table import Rows, read_rows, stated_rate_hz
from instrument.files.text import read_text
from instrument.interchange.found import Found
from instrument.interchange.read_table import Named, read_table
from instrument.interchange.said_by_name import part_in, unit_in

_SEPARATORS = (";", "\t", ",")
_MARKED = re.compile(r"[-+]?\d[\d.,]*(?:[eE][-+]?\d+)?")


def read_csv(path: Path) -> Found:
    """The table's sweep, FRF or record. Raises `BadInput` naming file and line."""
    header, table = _table(path)
    rate = stated_rate_hz(path)
    if rate is not None:
        table["sample_rate_hz"] = np.array([rate])
    found = Found()
    words = [name for name in header if name and name not in table]
    if words:
        found.said.append(f"passed over: {path.name}: {', '.join(words)[:200]}: no numbers")
    for name, part in _hits_apart(path, table):
        if not read_table(name, part, found):
            raise BadInput(
                f"{path}: header: found {', '.join(header)[:100]}, expected a frequency with a velocity or "
                "an FRF, or a force with a response and times; units in the names, as in velocity_mm_s or "
                "'Force [N]'; and two rows or more"
            )
    return found


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


def _table(path: Path) -> tuple[list[str], Named]:
    """All names, and the columns of numbers."""
    first = next((line for line in read_text(path).splitlines() if _is_said(line)), "")
    separator = next((s for s in _SEPARATORS if s in first), ",")
    names, rows = read_rows(path, separator=separator)
    if _is_units(rows[0][1]):
        names = [f"{n} [{u.strip('[]')}]" if u else n for n, u in zip(names, rows[0][1], strict=True)]
        rows = rows[1:]
    return names, _numbers(path, names, rows, comma=separator != ",")


def _is_said(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith("#")


def _is_units(row: list[str]) -> bool:
    """A second row without a number in it, below the names, holds units."""
    return not any(re.search(r"\d", re.sub(r"s\^?2|s²", "", field)) for field in row)


def _numbers(path: Path, names: list[str], rows: Rows, *, comma: bool) -> Named:
    """Columns of numbers; one of none, or of some and without a unit in its name, is text and passed over."""
    if not rows:
        raise BadInput(f"{path}: no rows below the header")
    if comma:
        _check_marks(path, rows)

    def is_numeric(k: int, name: str) -> bool:
        if unit_in(name) is not None or part_in(name) == "phase":
            return any(_is_number(row[k], comma=comma) for _, row in rows)
        return _is_number(rows[0][1][k], comma=comma)

    numeric = [k for k, name in enumerate(names) if name and is_numeric(k, name)]
    return {
        names[k]: np.array([_number(path, line, row[k], comma=comma) for line, row in rows]) for k in numeric
    }


def _check_marks(path: Path, rows: Rows) -> None:
    """Raise `BadInput` where commas and points stand in a file's numbers: one of them parts thousands."""
    fields = [(line, field) for line, row in rows for field in row if _MARKED.fullmatch(field)]
    points = [field for _, field in fields if "." in field]
    for line, field in fields:
        if "," in field and points:
            raise BadInput(
                f"{path}: line {line}: {field!r} beside {points[0]!r}, expected one decimal mark, and none "
                "between thousands"
            )


def _is_number(text: str, *, comma: bool) -> bool:
    try:
        float(text.replace(",", ".") if comma else text)
    except ValueError:
        return False
    return True


def _number(path: Path, line: int, text: str, *, comma: bool) -> float:
    if not _is_number(text, comma=comma):
        raise BadInput(f"{path}: line {line}: {text!r}, expected a number")
    return float(text.replace(",", ".") if comma else text)
