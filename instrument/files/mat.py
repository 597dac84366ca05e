"""MATLAB files: their variables, arrays squeezed and structs as dictionaries."""

from pathlib import Path
from typing import Any

from scipy.io import loadmat

from instrument.errors import BadInput
from instrument.files.mat_tags import check_tags


def read_mat_variables(path: Path) -> dict[str, Any]:
    """By name. Raises `BadInput`."""
    try:
        check_tags(path)
        content: dict[str, Any] = loadmat(str(path), simplify_cells=True)
    except BadInput:
        raise
    except NotImplementedError:
        raise BadInput(f"{path}: a MATLAB 7.3 file (HDF5), expected one saved with -v7 or earlier") from None
    except Exception as error:  # the library raises whatever it meets
        said = " ".join(str(error).split())[:80]
        raise BadInput(f"{path}: not a MATLAB file that can be read: {said}") from None
    return {name: value for name, value in content.items() if not name.startswith("__")}
