"""MATLAB files: their variables, arrays squeezed and structs as dictionaries."""

from pathlib import Path
from typing import Any

from scipy.io import loadmat

from instrument.errors import BadInput
from instrument.files.mat73 import is_mat73, read_mat73_variables
from instrument.files.mat_tags import check_tags


def read_mat_variables(path: Path) -> dict[str, Any]:
    """By name. Raises `BadInput`."""
    try:
        if is_mat73(path):
            return read_mat73_variables(path)
        check_tags(path)
        content: dict[str, Any] = loadmat(str(path), simplify_cells=True)
    except BadInput:
        raise
    except Exception as error:  # the library raises whatever it meets
        said = " ".join(str(error).split())[:80]
        raise BadInput(f"{path}: not a MATLAB file that can be read: {said}") from None
    return {name: value for name, value in content.items() if not name.startswith("__")}
