"""Rows of a CSV with their line numbers: `#` comments, one header; sample rates as a file says them."""

import cmath
import csv
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from fitting.arrays import Array
from instrument.errors import BadInput
from instrument.files.rates import rate_of_step
from instrument.files.text import IMPORT_READS, lines_of, read_text
from instrument.files.units import unit_of

Rows = list[tuple[int, list[str]]]
LARGEST = 1e30
"""A size in SI units that nothing measured has; its square is still a number."""
SMALLEST = 1e-30
"""A size in SI units below all that is measured; its square is still above 0."""
LARGEST_WHOLE = 1e9
"""Numbers of segments, passes and spots are small; beyond this a double may no longer be whole."""
LOWEST_HZ = 1e-6
"""Below it nothing vibrates, and the square of a frequency is lost beside a stiffness."""
_MOST_SHOWN = 60
"""Letters of a cell: no number needs as many."""
_RATE = re.compile(r"^#\s*sample_rate_hz\s*:\s*(\S+)", re.M)
_OFF_GRID = 0.2
"""Times are often written with few digits: judged by their place on the grid, in steps."""
_ROUNDING = 1e-12
"""Relative: times that are exact but for it are exact."""
_SPREADSHEET_ERROR = re.compile(r"\s*\"?#(N/A|DIV/0!|VALUE!|REF!|NAME\?|NUM!|NULL!)")
_EXCEL_MARK = re.compile("sep=", re.I)
_EXPECTED_FIRST = f"expected the names of the columns first; {IMPORT_READS}"
_FORTRAN = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)[dD][-+]?\d+")
_WITH_COMMA = re.compile(r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?")
_NO_UNIT = ("", "-", "1")
_AXES = ("hz", "khz", "rad/s", "s", "sec", "ms", "deg", "°", "rad", "°c", "degc", "c", "k")
"""Units of columns, in small letters, besides those of motions and forces."""
_DECIMAL_COMMA = re.compile(r"\d,\d")


def read_rows(
    path: Path, check_header: Callable[[list[str]], None] = lambda header: None
) -> tuple[list[str], Rows]:
    """The header, checked by `check_header`, and the rows with their line numbers, all equally long.

    Raises `BadInput` for what is not such a table.
    """
    header: list[str] | None = None
    top, rows = 0, list[tuple[int, list[str]]]()
    for line, row in _fields(path):
        if header is None:
            header, top = row, line
            _check_names(path, header)
            check_header(header)
            continue
        if len(row) != len(header):
            expected = f"{len(header)} as in the header (line {top})"
            raise BadInput(f"{path}: line {line}: {len(row)} columns, expected {expected}")
        if not rows:
            _check_units(path, line, row)
        rows.append((line, row))
    if header is None:
        raise BadInput(f"{path}: no header, expected a line of column names")
    if not rows:
        raise BadInput(f"{path}: no rows below the header")
    return header, rows


def read_header(path: Path) -> list[str]:
    """The names of the columns, whatever the rows below hold. Raises `BadInput` where there are none."""
    for _, header in _fields(path):
        _check_names(path, header)
        return header
    raise BadInput(f"{path}: no header, expected a line of column names")


def count_rows(path: Path) -> int:
    """How many rows stand below the header, whatever they hold. Raises `BadInput`."""
    return sum(1 for text in lines_of(path, read_text(path)) if _is_row(text)) - 1


def _check_names(path: Path, header: list[str]) -> None:
    for name in header:
        if name and header.count(name) > 1:
            raise BadInput(f"{path}: header: column {name} twice")
    _check_separator(path, header)


def _check_separator(path: Path, header: list[str]) -> None:
    """Raise `BadInput` where a header of one column is a row of names with another mark between them."""
    if _EXCEL_MARK.match(header[0]):
        raise BadInput(f"{path}: header: a spreadsheet's line {header[0]!r} above it, {_EXPECTED_FIRST}")
    if len(header) > 1:
        return
    for mark, name in ((";", "semicolons"), ("\t", "tabs")):
        if mark in header[0]:
            below = read_text(path).partition(header[0])[2]
            comma = " and decimal commas" if _DECIMAL_COMMA.search(below) else ""
            cure = "commas and decimal points" if comma else "commas"
            raise BadInput(
                f"{path}: header: {name} between the columns{comma}, expected {cure}; {IMPORT_READS}"
            )


def _check_units(path: Path, line: int, row: list[str]) -> None:
    """Raise `BadInput` where the first row has units, and no numbers."""
    cells = [cell for cell in row if cell not in _NO_UNIT]
    known = [cell.strip("[]()").lower() in _AXES or unit_of(cell) is not None for cell in cells]
    if known and all(known):
        said = ", ".join(cells)[:_MOST_SHOWN]
        raise BadInput(
            f"{path}: line {line}: units ({said}) below the header, expected numbers; {IMPORT_READS}"
        )


def number(path: Path, line: int, name: str, text: str) -> float:
    """A finite number of a size that is measured, or one line saying where it is not. Raises `BadInput`."""
    try:
        # Python also takes 1_4.3, and digits of other scripts.
        value = float(text if text.isascii() and "_" not in text else "no number")
    except ValueError:
        cure = f" (E before an exponent, not D); {IMPORT_READS}" if _FORTRAN.fullmatch(text) else ""
        cure = " with a decimal point" if _WITH_COMMA.fullmatch(text) else cure
        raise BadInput(f"{path}: line {line}: {name} = {shown(text)!r}, expected a number{cure}") from None
    check_size(f"{path}: line {line}", name, value, shown(text))
    return value


def check_size(where: str, name: str, value: complex, text: str) -> None:
    """Raise `BadInput` for what is no finite number, or beyond all that is measured."""
    if not cmath.isfinite(value):
        raise BadInput(f"{where}: {name} = {text}, expected a finite number")
    if abs(value) > LARGEST:
        raise BadInput(f"{where}: {name} = {text}, expected nothing beyond {LARGEST:g} in size")


def check_frequency(where: str, name: str, value: float, text: str) -> None:
    """Raise `BadInput` for a frequency that is above 0 Hz and none all the same."""
    if 0 < value < LOWEST_HZ:
        raise BadInput(f"{where}: {name} = {text}, expected at least {LOWEST_HZ:g} Hz")


def check_above_zero(where: str, name: str, value: float, text: str) -> None:
    """Raise `BadInput` for a size that is none, or so small that its powers are lost."""
    if value <= 0:
        raise BadInput(f"{where}: {name} = {text}, expected more than 0")
    if value < SMALLEST:
        raise BadInput(f"{where}: {name} = {shown(text)}, expected at least {SMALLEST:g}")


def check_whole(where: str, name: str, value: float, text: str) -> None:
    """Raise `BadInput` for a number that counts nothing."""
    if value != int(value) or abs(value) > LARGEST_WHOLE:
        raise BadInput(f"{where}: {name} = {shown(text)}, expected a whole number below 1e9")


def shown(text: str) -> str:
    """A cell as a message quotes it: a line has room for so much."""
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}..."


def stated_rate_hz(path: Path) -> float | None:
    """By a comment `# sample_rate_hz: ...`, where there is one. Raises `BadInput`."""
    return rate_stated_in(path, read_text(path))


def rate_stated_in(path: Path, text: str) -> float | None:
    """A rate stated as for `stated_rate_hz`, in a file's text. Raises `BadInput`."""
    found = _RATE.search(text)
    if found is None:
        return None
    rate = number(path, 1, "sample_rate_hz", found[1])
    if rate <= 0:
        raise BadInput(f"{path}: sample_rate_hz: {rate:g}, expected more than 0")
    return rate


def rate_of_times(t: Array) -> float | None:
    """Samples a second of times in s; None where they are not evenly spaced. Shape (samples,)."""
    step = (t[-1] - t[0]) / max(1, len(t) - 1)
    off = float(np.max(np.abs(t - np.linspace(t[0], t[-1], len(t)))))
    if not step > 0 or off > _OFF_GRID * step:
        return None
    return rate_of_step(float(step), 2 * off / float(t[-1] - t[0]) + _ROUNDING)


def is_comment(line: str) -> bool:
    """Whether a line is for people; a spreadsheet's error in its first cell is a value that is missing."""
    return line.lstrip().startswith("#") and not is_error(line)


def is_error(text: str) -> bool:
    """Whether a cell, or a line's first one, is what a spreadsheet writes where it has no value."""
    return _SPREADSHEET_ERROR.match(text) is not None


def _is_row(text: str) -> bool:
    return bool(text.strip()) and not is_comment(text)


def _fields(path: Path) -> Iterator[tuple[int, list[str]]]:
    for line, text in enumerate(lines_of(path, read_text(path)), start=1):
        if _is_row(text):
            if '"' not in text:
                # As the module does it, in a third of the time.
                yield line, [field.strip() for field in text.split(",")]
                continue
            try:
                yield line, [field.strip() for field in next(csv.reader([text], strict=True))]
            except csv.Error as error:
                raise BadInput(f"{path}: line {line}: {error}") from None
