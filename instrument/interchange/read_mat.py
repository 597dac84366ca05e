"""MATLAB files: named arrays, structs of them, and the structs of an LMS Test.Lab export."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from fitting.arrays import Array
from fitting.modal.frf import Motion
from instrument.errors import BadInput
from instrument.files.mat import read_mat_variables
from instrument.files.mat73 import NOT_READ
from instrument.files.rates import rate_of_step
from instrument.files.sweep_file import reading_said
from instrument.files.uff58 import HERTZ, SECONDS
from instrument.files.units import DERIVATIVE, KNOWN, Unit, unit_of
from instrument.interchange.found import Found, Ratio, motion_of
from instrument.interchange.naming import PASSED_OVER, Naming
from instrument.interchange.read_table import read_table
from instrument.interchange.signals import Named

_DEPTH = 4
_OUR_OWN = ("units", "about")


def read_mat(path: Path, naming: Naming | None = None) -> Found:
    """What its variables hold; `naming` has names in the place of their own. Raises `BadInput`."""
    every = read_mat_variables(path)
    variables = {n: v for n, v in every.items() if n not in _OUR_OWN}
    found = Found()
    # What an export of ours says of itself.
    found.reads = reading_said([str(line) for line in np.ravel(every.get("about", []))])
    if naming is not None:
        variables = _renamed(path, variables, naming)
    _walk(path, path.name, variables, found, 0)
    _testlab(path, variables, found)
    return found


def _renamed(path: Path, variables: dict[str, Any], naming: Naming) -> dict[str, Any]:
    """With other names of arrays, in whatever struct."""
    if naming.in_order:
        raise BadInput(f"{path}: arrays are in no order, expected OWN=NAME in --columns")
    naming.named(path.name, _names(variables))
    return _with_names(variables, naming.by_own)


def _names(struct: dict[str, Any]) -> Iterator[str]:
    for name, value in struct.items():
        if isinstance(value, dict):
            yield from _names(value)
        else:
            yield name


def _with_names(struct: dict[str, Any], by_own: dict[str, str]) -> dict[str, Any]:
    found = dict[str, Any]()
    for own, value in struct.items():
        inner = isinstance(value, dict)
        name = own if inner else by_own.get(own, own)
        if name in found or (name != own and name in struct):
            raise BadInput(f"--columns: {own} would be a second {name}, expected a name of its own")
        if name != PASSED_OVER:
            found[name] = _with_names(value, by_own) if inner else value
    return found


def _walk(path: Path, source: str, struct: dict[str, Any], found: Found, depth: int) -> None:
    """Arrays of one struct belong together."""
    table: Named = {n: np.asarray(v) for n, v in struct.items() if _is_numeric(v)}
    if table and not read_table(source, table, found):
        found.said.append(f"passed over: {source}: {', '.join(table)[:100]}")
    left = [n for n, v in struct.items() if _is_left(v)]
    if left:
        found.said.append(f"passed over: {source}: {', '.join(left)[:100]}: no array of numbers")
    for name, value in struct.items():
        if isinstance(value, dict) and not _is_function(value) and depth < _DEPTH:
            _walk(path, f"{source} {name}", value, found, depth + 1)


def _is_numeric(value: Any) -> bool:
    return np.asarray(value).dtype.kind in "fciub" and np.asarray(value).size > 0 and np.ndim(value) <= 2


def _is_left(value: Any) -> bool:
    """Whether it is a cell, a table, an object or an array of structs that are no functions of Test.Lab."""
    if isinstance(value, dict | str) or np.asarray(value, dtype=object).size == 0:
        return value is NOT_READ
    each = np.asarray(value, dtype=object).ravel() if isinstance(value, list) else np.ravel(value)
    return each.dtype.kind == "O" and not all(_is_function(one) for one in each)


# LMS Test.Lab: a struct a function, with its axis in x_values and its ordinate, unit and all, in y_values.


def _is_function(value: Any) -> bool:
    return isinstance(value, dict) and {"x_values", "y_values"} <= set(value)


def _testlab(path: Path, variables: dict[str, Any], found: Found) -> None:
    """FRFs as they are; a force's time record with the responses of its length and rate."""
    records: list[tuple[str, Unit, float, Array]] = []
    for name, function in variables.items():
        for k, one in enumerate(function if isinstance(function, list | np.ndarray) else [function], start=1):
            if _is_function(one):
                _function(path, name if one is function else f"{name} {k}", one, found, records)
    forces = [r for r in records if r[1].quantity == "force"]
    if len(forces) > 1:
        raise BadInput(
            f"{path}: {', '.join(f[0] for f in forces)}: {len(forces)} forces, expected one a file"
        )
    if not forces:
        if records:
            found.said.append(f"passed over: {', '.join(r[0] for r in records)}: no force among them")
        return
    name, _, rate, force = forces[0]
    responses: list[tuple[Motion, Array]] = [
        (motion_of(n, unit.quantity), samples)
        for n, unit, its_rate, samples in records
        if unit.quantity in DERIVATIVE and len(samples) == len(force) and abs(its_rate / rate - 1) < 1e-6
    ]
    if not responses:
        raise BadInput(f"{path}: {name}: no response of its length and rate beside the force")
    found.add_hit(path.name, rate, force, responses)


def _function(
    path: Path,
    name: str,
    function: dict[str, Any],
    found: Found,
    records: list[tuple[str, Unit, float, Array]],
) -> None:
    where = f"{path}: {name}"
    for key in ("x_values", "y_values"):
        if not isinstance(function[key], dict):
            raise BadInput(f"{where}: {key} is {function[key]!r:.40}, expected a struct")
    values = np.asarray(function["y_values"].get("values"))
    if values.ndim not in (1, 2) or values.dtype.kind not in "fciu":
        raise BadInput(
            f"{where}: y_values.values of shape {values.shape} and type {values.dtype}, expected a column of "
            "numbers for each response"
        )
    x = _abscissa(where, function["x_values"], values.shape[0])
    label = _label(function["y_values"])
    unit = unit_of(label)
    if unit is None:
        raise BadInput(f"{where}: ordinate in {label!r}, expected one of {KNOWN}, or one over another")
    columns = values[:, None] if values.ndim == 1 else values
    is_time, factor = _axis(where, _label(function["x_values"]))
    x = x * factor
    for k in range(columns.shape[1]):
        one = name if columns.shape[1] == 1 else f"{name} column {k + 1}"
        if unit.per is not None:
            if not np.iscomplexobj(columns):
                raise BadInput(f"{where}: real numbers, expected complex ones: amplitude or real part?")
            H = columns[:, k].astype(np.complex128) * unit.factor
            found.add_ratio(Ratio(one, x, H, unit.quantity, unit.per, response=one))
        elif is_time:
            records.append(
                (
                    one,
                    unit,
                    rate_of_step(float(x[1] - x[0]), 1e-12),
                    np.asarray(columns[:, k].real * unit.factor),
                )
            )
        else:
            found.said.append(f"passed over: {one}: a spectrum in {label}, expected one signal over another")


def _axis(where: str, label: str) -> tuple[bool, float]:
    """Whether an abscissa is of times, and its factor to s or Hz. Raises `BadInput` for another one."""
    for is_time, units in ((True, SECONDS), (False, HERTZ)):
        known = {unit.lower(): factor for unit, factor in units.items()}
        if label.lower() in known:
            return is_time, known[label.lower()]
    if label:
        raise BadInput(f"{where}: abscissa in {label!r}, expected {', '.join((*HERTZ, *SECONDS))}")
    return False, 1.0


def _abscissa(where: str, axis: dict[str, Any], count: int) -> Array:
    """`start_value`, `increment`, `number_of_values`, or the values themselves where they are uneven."""
    values = np.asarray(axis.get("values", []), float).ravel()
    if values.size == count:
        return values
    try:
        start, step = float(axis["start_value"]), float(axis["increment"])
    except (KeyError, TypeError, ValueError):
        raise BadInput(f"{where}: x_values without start_value and increment, and no values") from None
    if count < 2 or not step > 0:
        raise BadInput(
            f"{where}: {count} values at a step of {step:g}, expected 2 or more and a step above 0"
        )
    return np.asarray(start + step * np.arange(count), dtype=np.float64)


def _label(axis: dict[str, Any]) -> str:
    quantity = axis.get("quantity", {})
    label = quantity.get("label", "") if isinstance(quantity, dict) else ""
    return re.sub(r"\s+", "", str(label))
