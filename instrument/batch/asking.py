"""What a batch is asked to do: sessions and sweeps as named, or the rows of a table.

A table has the column `data`, and where they are wanted `specimen`, `hammer`, `temperature_c` and `material`;
others are passed over.
"""

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path

from instrument.batch.task import BatchTask
from instrument.errors import BadInput
from instrument.files.file_kind import refuse_another
from instrument.files.nearest import nearest
from instrument.files.plausible import INSIST
from instrument.files.table import Rows, number, read_rows
from instrument.files.text import read_text
from instrument.interchange.given import SESSION_ENDINGS, is_session
from instrument.interchange.questions import kelvin_doubt
from instrument.interchange.readers import foreign_endings, is_foreign

_OPTIONAL = ("hammer", "temperature_c", "material")
"""Columns of a table beside its data and specimens."""
_MEANT = 0.8
"""How alike an unknown column is to the one that was meant."""
_DATA = {".csv", *SESSION_ENDINGS, *foreign_endings()}
_MOST_SHOWN = 80
"""Letters of a header in a message."""
_COLDEST_C = -273.15
_WARM = re.compile(r"t|temp(?:eratur|erature)?(?:[^a-z].*)?", re.I)
"""Names of temperatures in whatever unit: left out, rows of all of them would be one group."""


def tasks_of(
    files: Sequence[Path],
    specimen: Path | None,
    hammer: Path | None = None,
    *,
    diagnose: bool = False,
    insist: bool = False,
) -> list[BatchTask]:
    """A row each, in order. Raises `BadInput` for what is wrong with the question, not with a file."""
    tables = [path for path in files if _is_table(path)]
    if tables and len(files) > 1:
        raise BadInput(f"{tables[0]}: a table beside other files, expected one table, or data only")
    if tables:
        found = _of_table(tables[0], specimen, hammer, insist=insist)
    else:
        found = [_task(path, specimen, hammer) for path in files]
        for path in files:
            if path.suffix.lower() == ".csv" and path.is_file():
                _refuse_a_list(path)
        lonely = next((t for t in found if t.specimen is None and not is_session(Path(t.data))), None)
        if lonely is not None:
            _refuse_no_data(Path(lonely.data))
            _refuse_a_list(Path(lonely.data))
            raise BadInput(
                f"{lonely.data}: Missing option '--specimen': a sweep does not say which plate it was "
                "(a table of sweeps begins with a column 'data', commas between its columns)"
            )
    return [replace(task, diagnose=diagnose, insist=insist) for task in found]


def _refuse_no_data(path: Path) -> None:
    """Raise `BadInput` for what no specimen makes a row of."""
    if not path.exists():
        raise BadInput(f"{path}: no such file")
    refuse_another(path, "a table", "sessions, sweeps, or one table of them")
    if not is_foreign(path):
        read_text(path)


def _task(data: Path, specimen: Path | None, hammer: Path | None) -> BatchTask:
    return BatchTask(str(data), str(specimen) if specimen else None, str(hammer) if hammer else None)


def _refuse_a_list(path: Path) -> None:
    """Raise `BadInput` for a table that names files in its first row, though not as ours do."""
    try:
        with open(path, encoding="utf-8-sig") as file:
            head, first = islice((line for line in file if line.strip() and not line.startswith("#")), 2)
    except (OSError, UnicodeDecodeError, ValueError):
        return
    heads, named = ([cell.strip(" \"'\n") for cell in re.split("[,;\t]", line)] for line in (head, first))
    meant = [name for name, cell in zip(heads, named, strict=False) if Path(cell).suffix.lower() in _DATA]
    if meant:
        near = f", the nearest is {meant[0]}" if meant[0] not in ("data", "") else ""
        raise BadInput(
            f"{path}: a list of files with the columns {head.strip()[:_MOST_SHOWN]}{near}: expected a column "
            "'data', commas between its columns; others are specimen, hammer, temperature_c, material"
        )


def _is_table(path: Path) -> bool:
    """A CSV with a column `data`; what cannot be read is none, and fails as a row."""
    if path.suffix.lower() != ".csv" or not path.is_file():
        return False
    try:
        with open(path, encoding="utf-8-sig") as file:
            head = next((line for line in file if line.strip() and not line.lstrip().startswith("#")), "")
    except (OSError, UnicodeDecodeError):
        return False
    return "data" in [name.strip().strip('"') for name in head.split(",")]


def _of_table(table: Path, specimen: Path | None, hammer: Path | None, *, insist: bool) -> list[BatchTask]:
    """Paths in a table are from the table's own folder."""

    def check(header: list[str]) -> None:
        assert "data" in header

    header, rows = read_rows(table, check)
    _check_specimens(table, header, rows, specimen)
    _check_optional(table, header)
    found = []
    for line, row in rows:
        cell = dict(zip(header, row, strict=True))
        if not cell["data"]:
            raise BadInput(f"{table}: line {line}: data is empty, expected a session or a sweep")
        t = cell.get("temperature_c") or ""
        warm = number(table, line, "temperature_c", t) if t else None
        if warm is not None and warm <= _COLDEST_C:
            raise BadInput(f"{table}: line {line}: temperature_c = {t}, expected more than {_COLDEST_C:g}")
        if not insist and (doubt := kelvin_doubt(warm)):
            raise BadInput(f"{table}: line {line}: {doubt}; {INSIST}")
        found.append(
            BatchTask(
                _beside(table, cell["data"]) or "",
                _beside(table, cell.get("specimen")) or (str(specimen) if specimen else None),
                _beside(table, cell.get("hammer")) or (str(hammer) if hammer else None),
                warm,
                cell.get("material") or None,
            )
        )
    return found


def _check_specimens(table: Path, header: list[str], rows: Rows, specimen: Path | None) -> None:
    """Raise `BadInput` where sweeps have no specimen and a column was meant to name it, or does name some."""
    if "specimen" in header:
        return
    for k, name in enumerate(header):
        named = next((row[k] for _, row in rows if row[k].lower().endswith(".toml")), None)
        if named is not None and name not in ("data", *_OPTIONAL):
            raise BadInput(f"{table}: header: column {name} has {named}, expected its name to be specimen")
    near = nearest("specimen", [name for name in header if name != "data"])
    if (
        specimen is None
        and near is not None
        and not all(is_session(Path(row[header.index("data")])) for _, row in rows)
    ):
        raise BadInput(f"{table}: header: no specimen, the nearest is {near}; expected it, or --specimen")


def _check_optional(table: Path, header: list[str]) -> None:
    """Raise `BadInput` where a column was meant to name a hammer test, a temperature or a material."""
    missing = [name for name in _OPTIONAL if name not in header]
    for name in header:
        if name in ("data", "specimen", *_OPTIONAL):
            continue
        is_warm = "temperature_c" in missing and _WARM.fullmatch(name) is not None
        meant = "temperature_c" if is_warm else nearest(name.lower(), missing, _MEANT)
        if meant is not None:
            raise BadInput(
                f"{table}: header: column {name} is unknown, the nearest is {meant}: expected that, or a "
                "name that is not like it"
            )


def _beside(table: Path, name: str | None) -> str | None:
    return str(table.parent / name) if name else None
