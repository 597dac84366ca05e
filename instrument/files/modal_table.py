"""A table of modes as CSV: `mode`, `frequency_hz`, `loss_factor`, optionally their standard deviations."""

from pathlib import Path

import numpy as np

from fitting.mode_tables.table import ModalTable
from instrument.errors import BadInput
from instrument.files.table import number, read_rows

_MUST = ("mode", "frequency_hz", "loss_factor")
_MAY = ("frequency_std_hz", "loss_factor_std", "temperature_c")


def is_modal_table(path: Path) -> bool:
    """Whether a CSV's header is a modal table's."""
    try:
        header, _ = read_rows(path)
    except BadInput:
        return False
    return set(_MUST) <= set(header)


def read_modal_table(path: Path) -> ModalTable:
    """Read and check a table. Raises `BadInput` naming file, line and column."""
    header, rows = read_rows(path)
    columns = {}
    for name in (*_MUST, *(n for n in _MAY if n in header)):
        k = header.index(name)
        values = []
        for line, row in rows:
            value = number(path, line, name, row[k])
            if (value <= 0 and name != "temperature_c") or (name == "mode" and value != int(value)):
                expected = "a whole number from 1" if name == "mode" else "more than 0"
                raise BadInput(f"{path}: line {line}: {name} = {row[k]}, expected {expected}")
            values.append(value)
        columns[name] = np.array(values)
    modes = columns["mode"]
    if len(np.unique(modes)) < len(modes):
        twice = next(int(m) for m in modes if np.sum(modes == m) > 1)
        raise BadInput(f"{path}: mode {twice} stands twice, expected each once")
    ascending = np.diff(columns["frequency_hz"][np.argsort(modes)])
    if np.any(ascending < 0):
        later = int(np.sort(modes)[1 + int(np.argmin(ascending))])
        raise BadInput(
            f"{path}: mode {later} lies below an earlier one, expected modes numbered by frequency"
        )
    return ModalTable(
        modes,
        columns["frequency_hz"],
        columns["loss_factor"],
        columns.get("frequency_std_hz"),
        columns.get("loss_factor_std"),
        columns.get("temperature_c"),
    )
