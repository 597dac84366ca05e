"""The JSON of `viscorig damping`, read back as natural frequencies and ratios."""

import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, Field, ValidationError

from instrument.errors import BadInput
from instrument.files.text import read_text

Array = NDArray[np.float64]


class _Mode(BaseModel):
    frequency_hz: float = Field(gt=0, allow_inf_nan=False)
    damping_ratio: float | None = Field(default=None, ge=0, lt=0.2, allow_inf_nan=False)
    accepted: bool = True


class _Document(BaseModel):
    modes: list[_Mode]


def read_hammer(path: Path) -> tuple[Array, Array]:
    """Frequencies in Hz and ratios (NaN where there is none) of the accepted modes. Raises `BadInput`."""
    try:
        document = _Document.model_validate(json.loads(read_text(path)))
    except json.JSONDecodeError as error:
        raise BadInput(f"{path}: line {error.lineno}: not JSON: {error.msg}") from None
    except (ValidationError, RecursionError) as error:
        first = error.errors()[0] if isinstance(error, ValidationError) else None
        place = ".".join(str(p) for p in first["loc"]) if first else "nesting"
        said = f": {first['msg'].lower()}" if first else ""
        raise BadInput(f"{path}: {place}{said}, expected the JSON of 'viscorig damping'") from None
    modes = [m for m in document.modes if m.accepted]
    if not modes:
        raise BadInput(f"{path}: no accepted mode")
    ratios = [np.nan if m.damping_ratio is None else m.damping_ratio for m in modes]
    return np.array([m.frequency_hz for m in modes]), np.array(ratios)
