"""batch.csv, and batch.parquet where pyarrow is installed: written row by row, whole or not at all."""

import csv
from collections.abc import Iterable
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import Any

from instrument.batch.columns import Cell, cells, columns_of
from instrument.batch.run import BatchRow
from instrument.files.at_once import at_once

CSV, PARQUET = "batch.csv", "batch.parquet"
_AT_ONCE = 500
"""Rows of a Parquet group."""
_WORDS = ("data", "specimen", "hammer", "status", "reason", "verdict", "effects", "law_kind", "warnings")
_WHETHER = ("converged", "borrowed_model")


def write_tables(rows: Iterable[BatchRow], folder: Path) -> list[Path]:
    """The files written. `rows` is gone through several times."""
    columns = columns_of(rows)
    written = [_write_csv(rows, columns, folder / CSV)]
    if find_spec("pyarrow") is not None:
        written.append(_write_parquet(rows, columns, folder / PARQUET))
    return written


def _write_csv(rows: Iterable[BatchRow], columns: list[str], path: Path) -> Path:
    with at_once(path) as draft, open(draft, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in rows:
            found = cells(row)
            writer.writerow([_text(found.get(name)) for name in columns])
    return path


def _text(cell: Cell) -> str:
    """Numbers so that they read back the same; nothing for what is not known."""
    if cell is None:
        return ""
    return str(cell).lower() if isinstance(cell, bool) else str(cell)


def _write_parquet(rows: Iterable[BatchRow], columns: list[str], path: Path) -> Path:
    import pyarrow as pa
    import pyarrow.parquet as pq

    kinds: dict[str, Any] = {"points": pa.int64()}
    kinds |= dict.fromkeys(_WORDS, pa.string()) | dict.fromkeys(_WHETHER, pa.bool_())
    schema = pa.schema([(name, kinds.get(name, pa.float64())) for name in columns])
    left = iter(rows)
    with at_once(path) as draft, pq.ParquetWriter(draft, schema) as writer:
        while some := [cells(row) for row in islice(left, _AT_ONCE)]:
            plain = [{name: found.get(name) for name in columns} for found in some]
            writer.write_table(pa.Table.from_pylist(plain, schema=schema))
    return path
