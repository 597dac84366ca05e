"""batch.csv, and batch.parquet where pyarrow is installed: written row by row, whole or not at all."""

import csv
import re
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import Any

from instrument.batch.columns import Cell, Marks, cells, columns_of
from instrument.batch.run import BatchRow
from instrument.files.at_once import at_once
from instrument.files.replaceable import Written

CSV, PARQUET = "batch.csv", "batch.parquet"
WRITTEN = {
    CSV: Written(re.compile(rb"data,specimen,[^\n]*,status,reason,")),
    PARQUET: Written(re.compile(rb"PAR1")),
}
"""Tables that a batch writes, and how each begins."""
_AT_ONCE = 500
"""Rows of a Parquet group."""
_WORDS = (
    "data",
    "specimen",
    "hammer",
    "material",
    "status",
    "reason",
    "verdict",
    "effects",
    "law_kind",
    "repeat_of",
    "warnings",
)
_WHETHER = ("converged", "borrowed_model")


def write_tables(rows: Iterable[BatchRow], folder: Path, marks: Marks | None = None) -> list[Path]:
    """Write the table of a batch in each format; the files written. `rows` is gone through several times."""
    columns = columns_of(rows)
    marks = marks or {}
    written = [_write_csv(rows, columns, marks, folder / CSV)]
    if find_spec("pyarrow") is not None:
        written.append(_write_parquet(rows, columns, marks, folder / PARQUET))
    return written


def _marked(rows: Iterable[BatchRow], marks: Marks) -> Iterator[dict[str, Cell]]:
    """The cells of every row, with what it is among the others."""
    return ({**cells(row), **marks.get(place, {})} for place, row in enumerate(rows))


def _write_csv(rows: Iterable[BatchRow], columns: list[str], marks: Marks, path: Path) -> Path:
    with at_once(path) as draft, open(draft, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for found in _marked(rows, marks):
            writer.writerow([_text(found.get(name)) for name in columns])
    return path


def _text(cell: Cell) -> str:
    """Numbers so that they read back the same; nothing for what is not known."""
    if cell is None:
        return ""
    return str(cell).lower() if isinstance(cell, bool) else str(cell)


def _write_parquet(rows: Iterable[BatchRow], columns: list[str], marks: Marks, path: Path) -> Path:
    import pyarrow as pa
    import pyarrow.parquet as pq

    kinds: dict[str, Any] = {"points": pa.int64()}
    kinds |= dict.fromkeys(_WORDS, pa.string()) | dict.fromkeys(_WHETHER, pa.bool_())
    schema = pa.schema([(name, kinds.get(name, pa.float64())) for name in columns])
    left = _marked(rows, marks)
    with at_once(path) as draft, pq.ParquetWriter(draft, schema) as writer:
        while some := list(islice(left, _AT_ONCE)):
            plain = [{name: found.get(name) for name in columns} for found in some]
            writer.write_table(pa.Table.from_pylist(plain, schema=schema))
    return path
