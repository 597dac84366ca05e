"""Variables of a MATLAB 7.3 file, which is HDF5: arrays squeezed and structs as dictionaries."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from instrument.errors import BadInput

_HEAD = b"MATLAB 7.3 MAT-file"
_DEPTH = 8
"""Structs within structs: a file that links to itself has no end."""
_MOST_VALUES = 200_000_000
"""Of one array: some 3 GB as complex numbers."""
_PARTS = {"real", "imag"}


def is_mat73(path: Path) -> bool:
    """Whether a file begins as one does."""
    with path.open("rb") as file:
        return file.read(len(_HEAD)) == _HEAD


def read_mat73_variables(path: Path) -> dict[str, Any]:
    """By name; cells, tables and objects are left out. Raises `BadInput`."""
    try:
        with h5py.File(path, "r") as file:
            return _struct(path, file, _DEPTH)
    except BadInput:
        raise
    except (OSError, KeyError, RuntimeError, TypeError, ValueError) as error:
        said = " ".join(str(error).split())[:80]
        raise BadInput(f"{path}: not a MATLAB 7.3 file that can be read: {said}") from None


def _struct(path: Path, group: Mapping[str, Any], depth: int) -> dict[str, Any]:
    if depth == 0:
        raise BadInput(f"{path}: structs within structs, expected {_DEPTH} or fewer")
    found = {}
    for name in group:
        if name.startswith("#") or not isinstance(group.get(name, getlink=True), h5py.HardLink):  # type: ignore[call-overload]
            continue
        node = group[name]
        value = _struct(path, node, depth - 1) if isinstance(node, h5py.Group) else _array(path, node)
        if value is not None:
            found[name] = value
    return found


def _array(path: Path, data: h5py.Dataset) -> Any:
    """None for what is no text and no numbers."""
    if data.size is None or data.size > _MOST_VALUES:
        raise BadInput(f"{path}: {data.name}: {data.size} values, expected {_MOST_VALUES} or fewer")
    if "MATLAB_empty" in data.attrs:
        return np.empty(0)
    values = data[()]
    kind = data.attrs.get("MATLAB_class", b"")
    if kind in (b"char", "char"):
        return "".join(map(chr, np.asarray(values).T.ravel()))
    if values.dtype.names is not None and set(values.dtype.names) == _PARTS:
        values = values["real"] + 1j * values["imag"]
    if values.dtype.kind not in "fciub":
        return None
    plain = np.squeeze(np.asarray(values).T)
    return plain.item() if plain.ndim == 0 else plain
