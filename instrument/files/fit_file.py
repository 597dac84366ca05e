"""The JSON of `viscorig identify`, read back as the law it found and how well that is known."""

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ValidationError

from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from instrument.errors import BadInput
from instrument.files.text import read_text

Array = NDArray[np.float64]


class FoundLaw(BaseModel):
    """Parameters in SI units; null where the data do not fix one."""

    law_kind: str
    parameters: dict[str, float]
    standard_errors: dict[str, float | None]
    correlations: dict[str, dict[str, float | None]]

    def law(self, start: CoreLaw) -> CoreLaw:
        """The law found, of the kind the specimen has. Raises `BadInput`, `OutsideModel`."""
        if self.law_kind != start.kind or set(self.parameters) != set(start.names):
            raise BadInput(f"the law found is {self.law_kind}, expected the specimen's own, {start.kind}")
        return start.with_values(np.array([self.parameters[name] for name in start.names]))

    def covariance(self, names: list[str]) -> Array:
        """Of the log parameters by noise; a parameter without error, at its limit, does not move.

        NaN where none has an error. Shape (parameters, parameters).
        """
        errors = np.array([_number(self.standard_errors.get(name)) for name in names])
        if np.isnan(errors).all():
            return np.full((len(names), len(names)), np.nan)
        size = errors / np.array([self.parameters[name] for name in names])
        like = np.array([[_number(self.correlations.get(a, {}).get(b)) for b in names] for a in names])
        return np.asarray(np.nan_to_num(like * np.outer(size, size)))


def read_fit(path: Path) -> FoundLaw:
    """The JSON of `viscorig identify`. Raises `BadInput`."""
    try:
        return found_law(json.loads(read_text(path)))
    except json.JSONDecodeError as error:
        raise BadInput(f"{path}: line {error.lineno}: not JSON: {error.msg}") from None
    except (ValidationError, RecursionError, OutsideModel):
        raise BadInput(f"{path}: expected the JSON of 'viscorig identify'") from None


def found_law(facts: Any) -> FoundLaw:
    """The same from the facts themselves. Raises `ValidationError`."""
    return FoundLaw.model_validate(facts)


def _number(value: float | None) -> float:
    return np.nan if value is None else value
