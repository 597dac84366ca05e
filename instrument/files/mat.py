"""MATLAB files: their variables, arrays squeezed and structs as dictionaries."""

from math import prod
from pathlib import Path
from typing import Any

from scipy.io import loadmat, whosmat

from instrument.errors import BadInput
from instrument.files.mat73 import MOST_BYTES, is_mat73, read_mat73_variables
from instrument.files.mat_tags import check_tags

_WIDEST = 16
"""Bytes of a complex number."""
_NO_ARRAYS = ("struct", "cell", "object", "function", "opaque")


def read_mat_variables(path: Path) -> dict[str, Any]:
    """The variables of a .mat file by name. Raises `BadInput`."""
    try:
        if is_mat73(path):
            return read_mat73_variables(path)
        check_tags(path)
        _check_sizes(path)
        content: dict[str, Any] = loadmat(str(path), simplify_cells=True)
    except BadInput:
        raise
    except Exception as error:  # the library raises whatever it meets
        said = " ".join(str(error).split())[:80]
        raise BadInput(f"{path}: not a MATLAB file that can be read: {said}") from None
    return {name: value for name, value in content.items() if not name.startswith("__")}


def _check_sizes(path: Path) -> None:
    """Raise `BadInput` for more than any measurement has: what is compressed may be of any size."""
    size = sum(_WIDEST * prod(shape) for _, shape, kind in whosmat(str(path)) if kind not in _NO_ARRAYS)
    if size > MOST_BYTES:
        raise BadInput(f"{path}: more than {MOST_BYTES / 1e9:g} GB of arrays in all")
