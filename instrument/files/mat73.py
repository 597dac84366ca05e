"""Variables of a MATLAB 7.3 file, which is HDF5: arrays squeezed and structs as dictionaries."""

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from instrument.errors import BadInput

_HEADS = (b"MATLAB 7.3 MAT-file", b"\x89HDF\r\n\x1a\n")
"""MATLAB's own, and that of other programs that write as it does."""
_DEPTH = 8
"""Structs within structs: a file that links to itself has no end ..."""
_MOST_NODES = 10_000
"""... and one whose structs share others has next to none."""
MOST_BYTES = 1_000_000_000
"""Of all arrays of a file: a compressed one may be any number of times as large as the file."""
_PARTS = {"real", "imag"}
"""Of a complex number."""
_LONGEST = 1_000_000
"""Characters of a text."""
NOT_READ = np.empty(0, dtype=object)
"""In the place of a cell, a table or an object."""


def is_mat73(path: Path) -> bool:
    """Whether a file begins as one does."""
    with path.open("rb") as file:
        return file.read(len(max(_HEADS, key=len))).startswith(_HEADS)


def read_mat73_variables(path: Path) -> dict[str, Any]:
    """By name; what is no text and no numbers is `NOT_READ`. Raises `BadInput`."""
    try:
        with h5py.File(path, "r") as file:
            return _Reader(path).struct(file, _DEPTH)
    except BadInput:
        raise
    except (OSError, KeyError, RuntimeError, TypeError, ValueError) as error:
        said = " ".join(str(error).split())[:80]
        raise BadInput(f"{path}: not a MATLAB 7.3 file that can be read: {said}") from None


@dataclass
class _Reader:
    path: Path
    nodes: int = 0
    bytes: int = 0

    def struct(self, group: Any, depth: int) -> dict[str, Any]:
        """Of a group; links to elsewhere are none of its own."""
        if depth == 0:
            raise BadInput(f"{self.path}: structs within structs, expected {_DEPTH} or fewer")
        found = {}
        for name in group:
            if not isinstance(name, str) or name.startswith("#"):
                continue
            if not isinstance(group.get(name, getlink=True), h5py.HardLink):
                continue
            self.nodes += 1
            if self.nodes > _MOST_NODES:
                raise BadInput(f"{self.path}: more than {_MOST_NODES} variables and fields")
            node = group[name]
            found[name] = self.struct(node, depth - 1) if isinstance(node, h5py.Group) else self.array(node)
        return found

    def array(self, data: Any) -> Any:
        """Of a dataset that lies in the file itself."""
        if not isinstance(data, h5py.Dataset) or data.external or data.is_virtual:
            return NOT_READ
        if "MATLAB_empty" in data.attrs:
            return np.empty(0)
        kind = data.attrs.get("MATLAB_class")
        is_text = isinstance(kind, bytes | str) and kind in (b"char", "char")
        if data.shape is None or not _is_numeric(data.dtype) or (is_text and data.size > _LONGEST):
            return NOT_READ
        self.bytes += data.size * data.dtype.itemsize
        if self.bytes > MOST_BYTES:
            raise BadInput(f"{self.path}: {data.name}: more than {MOST_BYTES / 1e9:g} GB of arrays in all")
        values = np.asarray(data[()])
        if is_text:
            with suppress(ValueError, OverflowError, TypeError):
                return "".join(map(chr, values.T.ravel().tolist()))
            return NOT_READ
        if values.dtype.names is not None:
            values = values["real"] + 1j * values["imag"]
        plain = np.squeeze(values.T)
        return plain.item() if plain.ndim == 0 else plain


def _is_numeric(kind: np.dtype[Any]) -> bool:
    if kind.names is None:
        return kind.kind in "fciub"
    parts = [kind[name] for name in kind.names]
    return set(kind.names) == _PARTS and all(part.kind in "fiu" and part.subdtype is None for part in parts)
