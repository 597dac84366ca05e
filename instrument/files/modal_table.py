"""A table of modes as CSV: `mode`, `frequency_hz`, `loss_factor`, optionally their standard deviations."""

import re
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.mode_tables.as_read import READS, Read
from fitting.mode_tables.table import ModalTable
from instrument.errors import BadInput
from instrument.files.nearest import nearest
from instrument.files.table import check_above_zero, check_frequency, number, read_header, read_rows
from instrument.files.text import IMPORT_READS, read_text

_SAID = re.compile(r"^\s*#\s*read\s*:\s*(.*?)\s*$", re.MULTILINE | re.IGNORECASE)
_MUST = ("mode", "frequency_hz", "loss_factor")
_MAY = ("frequency_std_hz", "loss_factor_std", "temperature_c")
_ABSOLUTE_ZERO_C = -273.15
_OF_OTHERS = ("veloc", "accel", "displac", "recept", "mobil", "force", "storage", "time", "coheren")
"""How columns of sweeps, FRFs, records and laws begin."""
_MEANT = 0.8
"""How alike a column is to the one that was meant."""
_SLIP = 0.88
"""How alike a column is to an optional one of which it is a slip; `loss_factor_fit` is a name of its own."""
_SPREADS = frozenset(("sd", "std", "stdev", "sigma", "se", "err", "error", "unc", "uncertainty"))
_OF_LOSS = frozenset(("loss", "eta", "damping", "tan"))
_WARM = frozenset(("temp", "temperature"))
_ONE_K = 0.5
"""Rows so near the coldest of them are of one temperature: a chamber holds it, a thermometer reads it so."""
_MOST_MODES = 1000
"""No test numbers so many modes. A choice."""


def is_modal_table(path: Path) -> bool:
    """Whether a CSV's header is a modal table's, or was meant to be one."""
    try:
        header = read_header(path)
    except BadInput:
        return False
    if set(_MUST) <= set(header):
        return True
    if any(name.lower().startswith(_OF_OTHERS) for name in header):
        return False
    return "mode" in header or nearest("loss_factor", header, _MEANT) is not None


def _check_header(path: Path, header: list[str]) -> None:
    missing = [name for name in _MUST if name not in header]
    unknown = [name for name in header if name not in (*_MUST, *_MAY)]
    if not missing:
        _check_optional(path, header, unknown)
        return
    meant = nearest(missing[0], unknown)
    near = f", the nearest is {meant}" if meant is not None else ""
    expected = f"expected {', '.join(_MUST)} of a table of modes; {IMPORT_READS}"
    raise BadInput(f"{path}: header: no {missing[0]}{near}; {expected}")


def _check_optional(path: Path, header: list[str], unknown: list[str]) -> None:
    """Left out in silence, a standard deviation or a temperature would give another law."""
    for name in unknown:
        meant = _meant_by(name)
        if meant is not None and meant not in header:
            raise BadInput(
                f"{path}: header: column {name} is unknown, the nearest is {meant}: expected that, or a name "
                "that is not like it"
            )


def _meant_by(name: str) -> str | None:
    """Which optional column a name is of: a slip of the pen, or its other words."""
    alike = nearest(name, _MAY, _SLIP)
    if alike is not None:
        return alike
    words = name.lower().split("_")
    if not _SPREADS.isdisjoint(words):
        return "loss_factor_std" if not _OF_LOSS.isdisjoint(words) else "frequency_std_hz"
    return "temperature_c" if words[0] in _WARM else None


def read_modal_table(path: Path) -> ModalTable:
    """Read and check a table. Raises `BadInput` naming file, line and column."""
    columns = _columns(path)
    warm = columns.get("temperature_c")
    several = warm is not None and float(np.ptp(warm)) > _ONE_K
    _check_modes(
        path,
        columns,
        "; rows of several temperatures go with 'identify --shift', or in a table each" * several,
    )
    return _table(path, columns)


def read_modal_tables(path: Path) -> list[ModalTable]:
    """A table of several temperatures, those of one temperature apart, the coldest first.

    The row order says nothing; a mode that was measured more than once at one temperature has the mean of its
    readings. Raises `BadInput`, also where a row has no temperature.
    """
    columns = _columns(path)
    if "temperature_c" not in columns:
        raise BadInput(f"{path}: no temperature, expected a column temperature_c; {IMPORT_READS}")
    found = []
    for rows in _at_one_temperature(columns["temperature_c"]):
        some = _each_mode_once({name: values[rows] for name, values in columns.items()})
        where = f" at {some['temperature_c'].mean():g} degC"
        _check_modes(path, some, "", where)
        found.append(_table(path, some))
    return found


def _at_one_temperature(temperature_c: Array) -> list[NDArray[np.intp]]:
    """Rows that belong together: within `_ONE_K` of the coldest."""
    left, found = np.argsort(temperature_c, kind="stable"), []
    while left.size:
        near = temperature_c[left] - temperature_c[left[0]] <= _ONE_K
        found.append(left[near])
        left = left[~near]
    return found


def _each_mode_once(columns: dict[str, Array]) -> dict[str, Array]:
    """The same with means of what was measured again; a row copied to the last digit is no measurement."""
    rows = np.unique(np.array([columns[name] for name in columns]), axis=1)
    given = dict(zip(columns, rows, strict=True))
    found = {"mode": np.unique(given["mode"])}
    its = [given["mode"] == mode for mode in found["mode"]]
    for name, std in (("frequency_hz", "frequency_std_hz"), ("loss_factor", "loss_factor_std")):
        weight = given[std] ** -2 if std in given else np.ones(len(given["mode"]))
        found[name] = np.array([np.average(given[name][k], weights=weight[k]) for k in its])
        if std in given:
            found[std] = np.array([weight[k].sum() ** -0.5 for k in its])
    found["temperature_c"] = np.array([given["temperature_c"][k].mean() for k in its])
    return found


def read_modal_rows(path: Path) -> dict[str, Array]:
    """Columns of a table of one temperature or of several, shape (rows,) each. Raises `BadInput`."""
    columns = _columns(path)
    if "temperature_c" not in columns:
        _check_modes(path, columns)
    return columns


def _columns(path: Path) -> dict[str, Array]:
    header, rows = read_rows(path, lambda header: _check_header(path, header))
    columns = {}
    for name in (*_MUST, *(n for n in _MAY if n in header)):
        k = header.index(name)
        values = []
        for line, row in rows:
            value = number(path, line, name, row[k])
            whole = name != "mode" or (value == int(value) and value <= _MOST_MODES)
            if (value <= 0 and name != "temperature_c") or not whole:
                expected = f"a whole number from 1 to {_MOST_MODES}" if name == "mode" else "more than 0"
                raise BadInput(f"{path}: line {line}: {name} = {row[k]}, expected {expected}")
            if name == "temperature_c" and value <= _ABSOLUTE_ZERO_C:
                expected = f"degrees Celsius above {_ABSOLUTE_ZERO_C}"
                raise BadInput(f"{path}: line {line}: {name} = {row[k]}, expected {expected}")
            if name == "frequency_hz":
                check_frequency(f"{path}: line {line}", name, value, row[k])
            elif name not in ("mode", "temperature_c"):
                check_above_zero(f"{path}: line {line}", name, value, row[k])
            values.append(value)
        columns[name] = np.array(values)
    return columns


def _check_modes(path: Path, columns: dict[str, Array], cure: str = "", where: str = "") -> None:
    modes = columns["mode"]
    if len(np.unique(modes)) < len(modes):
        twice = next(int(m) for m in modes if np.sum(modes == m) > 1)
        raise BadInput(f"{path}: mode {twice} stands twice, expected each once{cure}")
    ascending = np.diff(columns["frequency_hz"][np.argsort(modes)])
    if np.any(ascending < 0):
        later = int(np.sort(modes)[1 + int(np.argmin(ascending))])
        raise BadInput(
            f"{path}: mode {later}{where} lies below an earlier one, expected modes numbered by frequency"
        )


def _table(path: Path, columns: dict[str, Array]) -> ModalTable:
    return ModalTable(
        columns["mode"],
        columns["frequency_hz"],
        columns["loss_factor"],
        columns.get("frequency_std_hz"),
        columns.get("loss_factor_std"),
        columns.get("temperature_c"),
        path.name,
        read_said(path, read_text(path)),
    )


def read_said(path: Path, text: str) -> Read | None:
    """What a line '# read: ...' of a file's text says. Raises `BadInput`."""
    said = {one.lower() for one in _SAID.findall(text)}
    if not said:
        return None
    if len(said) > 1 or not said <= set(READS):
        raise BadInput(f"{path}: read: {' and '.join(sorted(said))}, expected one of {', '.join(READS)}")
    return cast(Read, said.pop())
