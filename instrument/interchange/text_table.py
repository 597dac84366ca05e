"""Where in another program's text its table is: what stands above it, its names, its units, its rows.

The table is the longest run of lines of numbers. The line above it holds the names, with their units or with
a line of units below or above them; whatever is higher up is the program's own.
"""

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby, product
from pathlib import Path
from typing import NamedTuple

from instrument.errors import BadInput
from instrument.files.table import Rows, is_comment, is_error
from instrument.files.text import lines_of
from instrument.files.units import unit_of
from instrument.interchange.naming import PASSED_OVER, Naming
from instrument.interchange.preamble import named_by_preamble, with_stated_units
from instrument.interchange.unit_in_name import bracketed

_MOST_SHOWN = 60
"""Letters of a line in a message."""
SEPARATORS = (";", "\t", ",", "")
"""Between columns; empty for blanks, any number of them."""
_SAMPLED = 1000
"""Lines that are looked at for what separates their columns, before all are."""
_NUMBER = re.compile(r"[-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eEdD][-+]?\d+)?|[-+]?(?:nan|inf)", re.I)
_COMPLEX = re.compile(r"[-+]?[\d.]+(?:[eE][-+]?\d+)?\s*[-+]\s*[\d.]+(?:[eE][-+]?\d+)?\s*\*?[ij]")
_COMMENT = re.compile(r"^\s*(?:#|%|!|\*|//)+\s*")
_AXES = ("hz", "khz", "rad/s", "s", "sec", "ms")
_UNITS = {*_AXES, "", "-", "1", "deg", "degree", "degrees", "°", "rad", "v", "pa"}
"""Besides those of motions and forces."""
_BRACKETS = re.compile(r"^\s*[\[(]\s*|\s*[\])]\s*$")
_BY_BRACKET = re.compile(r"\s+(?![\[(])(?![^\[(]*[\])])")


@dataclass(frozen=True)
class TextTable:
    """A table as it stands in a file."""

    names: list[str]
    rows: Rows
    separator: str
    said: list[str]
    """For people: where it was found."""


def find_table(path: Path, text: str, naming: Naming | None = None) -> TextTable:
    """The table of a text; `naming` has names in the place of its own.

    Raises `BadInput` where there is none, or more than one.
    """
    lines = [(n, line) for n, line in enumerate(lines_of(path, text), start=1) if line.strip()]
    separator = _separator(lines)
    fields = [(n, _fields(path, n, line, separator)) for n, line in lines if not is_comment(line)]
    first, count = _longest_run(fields)
    if count == 0:
        raise BadInput(f"{path}: no rows of numbers, expected a table with a line of names above it")
    _check_above(path, fields[:first], fields[first])
    rows = fields[first:]
    above = [(n, line) for n, line in lines if n < rows[0][0]]
    if naming is not None and naming.in_order:
        n, row = rows[0]
        names = list(naming.in_order)
        if len(names) not in {len(row), _filled(rows)}:
            raise BadInput(
                f"{path}: line {n}: {len(row)} columns, expected {len(names)} as --columns has names"
            )
        return _even(path, TextTable(names, rows, separator, []))
    return _even(path, _named(path, above, rows, separator, naming or Naming()))


def is_number(text: str, *, comma: bool) -> bool:
    """Whether a field is one number, real or complex; `comma`: decimal commas are read."""
    return (_NUMBER.fullmatch(text) is not None and (comma or "," not in text)) or _COMPLEX.fullmatch(
        text
    ) is not None


def number_of(text: str, *, comma: bool) -> complex:
    """Of a field that `is_number`; exponents may be Fortran's (D)."""
    pointed = text.replace(",", ".") if comma else text
    try:
        return complex(float(pointed))
    except ValueError:
        plain = re.sub(r"(?<=\d|\.)[dD](?=[-+]?\d)", "e", pointed)
    return complex(
        re.sub(r"[\s*]", "", plain).replace("i", "j") if _COMPLEX.fullmatch(text) else float(plain)
    )


# Lines


def _fields(path: Path, n: int, line: str, separator: str) -> list[str]:
    if not separator:
        return line.split()
    if '"' not in line:
        return [f.strip() for f in line.split(separator)]
    try:
        return [f.strip() for f in next(csv.reader([line], delimiter=separator, strict=True))]
    except csv.Error as error:
        raise BadInput(f"{path}: line {n}: {error}") from None


def _loose(line: str, separator: str) -> list[str]:
    return [f.strip().strip('"') for f in (line.split(separator) if separator else line.split())]


def _is_row(fields: Sequence[str], *, comma: bool = True, begun: bool = True) -> bool:
    """Whether two fields or more are numbers; with `begun` the first one is."""
    if begun and not (fields and is_number(fields[0], comma=comma)):
        return False
    found = (f for f in fields if is_number(f, comma=comma))
    return next(found, None) is not None and next(found, None) is not None


def _separator(lines: Sequence[tuple[int, str]]) -> str:
    """That by which most lines are rows, of numbers alone before others; the first of several."""

    def score(separator: str, some: Sequence[tuple[int, str]], *, begun: bool) -> float:
        split = [_loose(line, separator) for _, line in some]
        rows = [r for r in split if _is_row(r, comma=separator != ",", begun=begun)]
        whole = sum(all(is_number(f, comma=separator != ",") for f in r if f) for r in rows)
        return (len(rows) + whole) / 2

    for some, begun in product((lines[:_SAMPLED], lines), (True, False)):
        scores = {s: score(s, some, begun=begun) for s in SEPARATORS}
        if max(scores.values()) > 0:
            return max(scores, key=scores.__getitem__)
    return ","


def _longest_run(fields: Sequence[tuple[int, list[str]]]) -> tuple[int, int]:
    """Place and length of the longest run of rows of one width; of equals the first."""
    for begun in (True, False):
        widths = [len(row) if _is_row(row, begun=begun) else 0 for _, row in fields]
        best, place = (0, 0), 0
        for width, run in groupby(widths):
            length = len(list(run))
            if width and length > best[1]:
                best = place, length
            place += length
        if best[1] > 0:
            return best
    return 0, 0


def _check_above(path: Path, above: Sequence[tuple[int, list[str]]], first: tuple[int, list[str]]) -> None:
    """Raise `BadInput` for rows above the table: a part of it would be lost in silence."""
    for n, row in above:
        if _is_row(row) and (len(row) == len(first[1]) or n == above[-1][0]):
            for odd, cells in reversed(above):
                names = all(cell and not is_number(cell, comma=True) and not is_error(cell) for cell in cells)
                if odd > n and len(cells) == len(first[1]) and not names and not _is_row(cells):
                    shown = ", ".join(cells)[:_MOST_SHOWN]
                    raise BadInput(f"{path}: line {odd}: {shown!r} among rows of numbers, expected numbers")
            for odd, cells in above:
                if odd > n and len(row) == len(first[1]) != len(cells) and _is_row(cells):
                    around = f"{len(row)} as in line {n} and in line {first[0]}"
                    raise BadInput(f"{path}: line {odd}: {len(cells)} columns, expected {around}")
            table = f"the table that begins in line {first[0]} with {len(first[1])}"
            raise BadInput(
                f"{path}: line {n}: {len(row)} columns of numbers above {table}, expected one table"
            )


# Names


def _named(
    path: Path, lines: Sequence[tuple[int, str]], rows: Rows, separator: str, naming: Naming
) -> TextTable:
    """With the names, and the units, that stand above the rows; a comment's where there are no others."""
    preamble = [line for _, line in lines]
    widths = {len(rows[0][1]), _filled(rows)}
    for above in ([line for line in lines if not is_comment(line[1])], lines):
        near = [(n, _cells(line, separator, widths)) for n, line in reversed(above[-2:])]
        names = _of_lines([cells for _, cells in near])
        if names is None:
            continue
        at = near[-1 if names.lines > 1 else 0][0]
        left = sum(n < at for n, _ in lines)
        above_it = "the line" if left == 1 else f"{left} lines"
        said = [f"names in line {at}, {above_it} above it passed over"] if left else []
        made, stated = with_stated_units(naming.named(str(path), names.names), preamble)
        return TextTable(made, rows, separator, said + stated)
    known = named_by_preamble(preamble, rows)
    if known is None:
        raise _nameless(path, lines, rows, separator)
    known = naming.named(str(path), known)
    return TextTable(known, rows, separator, [f"names by its head of {len(preamble)} lines"])


class _Names(NamedTuple):
    names: list[str]
    lines: int


def _of_lines(near: Sequence[list[str] | None]) -> _Names | None:
    """Names in one line or, with their units above or below them, in two; the nearest first."""
    lower, upper = (near[k] if k < len(near) else None for k in range(2))
    if lower is None or not _are_names(lower):
        return None
    if upper is not None and len(upper) == len(lower) and _are_names(upper):
        for names, units in ((upper, lower), (lower, upper)):
            if _are_units(units) and not _are_units(names) and not _have_units(names):
                return _Names(list(map(_with_unit, names, units)), 2)
    return _Names(lower, 1)


def _filled(rows: Rows) -> int:
    """Columns up to the last one with anything in it."""
    return max(max((k for k, cell in enumerate(row, start=1) if cell), default=0) for _, row in rows)


def _cells(line: str, separator: str, widths: set[int]) -> list[str] | None:
    """A line of names split into as many as there are columns; None where it does not."""
    plain = _COMMENT.sub("", line) if _COMMENT.match(line) else line
    ways = [_loose(plain, separator)]
    if not separator:
        ways += [re.split(r"\s{2,}", plain.strip()), _BY_BRACKET.split(plain.strip())]
    elif _COMMENT.match(line):
        ways += [_loose(plain, s) for s in SEPARATORS]
    for cells in ways:
        while len(cells) > max(widths) and not cells[-1]:
            cells.pop()
        if len(cells) in widths:
            return cells
    return None


def _are_names(cells: Sequence[str]) -> bool:
    return any(cells) and not any(is_number(c, comma=True) for c in cells)


def _are_units(cells: Sequence[str]) -> bool:
    """Whether all stand in brackets, the first is an axis's, or most are units that are known."""
    said = [c for c in cells if c]
    plain = [_BRACKETS.sub("", c).lower() for c in said]
    if all(re.fullmatch(r"\[.*\]", c) for c in said) or plain[0] in _AXES:
        return True
    known = [p in _UNITS or unit_of(c) is not None for p, c in zip(plain, said, strict=True)]
    return sum(known) > len(known) / 2


def _have_units(names: Sequence[str]) -> bool:
    return any(unit and _are_units([unit]) for unit, _ in map(bracketed, names))


def _with_unit(name: str, unit: str) -> str:
    plain = unit.strip()
    plain = plain[1:-1].strip() if re.fullmatch(r"\[.*\]", plain) else plain
    return f"{name} [{plain}]" if plain and plain != "-" else name


def _nameless(path: Path, above: Sequence[tuple[int, str]], rows: Rows, separator: str) -> BadInput:
    n, row = rows[0]
    cells = _loose(above[-1][1], separator) if above else []
    if len(cells) > 1 and _are_names(cells):
        header = f"{len(cells)} as in the header (line {above[-1][0]})"
        return BadInput(f"{path}: line {n}: {len(row)} columns, expected {header}")
    expected = f"one, or --columns with {len(row)} names"
    return BadInput(f"{path}: no line of names above the numbers in line {n}, expected {expected}")


# Rows


def _even(path: Path, table: TextTable) -> TextTable:
    """All rows as wide as the names; empty fields behind the names are dropped."""
    names = table.names
    while names and not names[-1]:
        names = names[:-1]
    table, width = replace(table, names=names), len(names)
    rows = []
    for n, row in table.rows:
        cut = row[:width] if not any(row[width:]) else row
        if len(cut) != width and not _is_row(row):
            raise BadInput(
                f"{path}: line {n}: {' '.join(row)[:40]!r} below the table that begins in line "
                f"{table.rows[0][0]}, expected one table and nothing behind it"
            )
        if len(cut) != width:
            began = f"the table that begins in line {table.rows[0][0]}"
            raise BadInput(f"{path}: line {n}: {len(row)} columns, expected {width} as in {began}")
        rows.append((n, cut))
    for name in table.names:
        if name not in ("", PASSED_OVER) and table.names.count(name) > 1:
            raise BadInput(f"{path}: header: column {name} twice, expected --columns with {width} names")
    return replace(table, rows=rows)
