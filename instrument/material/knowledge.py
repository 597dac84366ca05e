"""How well a law is known as a whole, as a result says it."""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, Field, ValidationError, model_validator

from fitting.arrays import Array
from fitting.identification.known_curve import KnownCurve

_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Triangle = list[list[_Finite]]
"""Rows of the lower triangle, the diagonal last in each."""


class _Known(BaseModel):
    frequency_hz: list[Annotated[float, Field(gt=0, allow_inf_nan=False)]] = Field(min_length=2)
    covariance: _Triangle
    of_another_measurement: _Triangle
    stated: dict[str, list[_Finite]] = {}

    @model_validator(mode="after")
    def _whole(self) -> "_Known":
        rows = 2 * len(self.frequency_hz)
        if any(b <= a for a, b in zip(self.frequency_hz, self.frequency_hz[1:], strict=False)):
            raise ValueError("expected ascending frequencies")
        for triangle in (self.covariance, self.of_another_measurement):
            if [len(row) for row in triangle] != list(range(1, rows + 1)):
                raise ValueError("expected the rows of a lower triangle, two a frequency")
        if any(len(column) != rows for column in self.stated.values()):
            raise ValueError("expected a number for every row of the covariance")
        return self


def known_curve_of(facts: Mapping[str, Any]) -> KnownCurve | None:
    """Of the JSON of a fit, or of a stage of a diagnosis; None where it does not say."""
    try:
        known = _Known.model_validate(facts.get("law_known"))
    except ValidationError:
        return None
    columns = [np.array(column) for column in known.stated.values()]
    return KnownCurve(
        np.array(known.frequency_hz),
        _whole(known.covariance),
        _whole(known.of_another_measurement),
        np.stack(columns, axis=1) if columns else np.zeros((2 * len(known.frequency_hz), 0)),
        tuple(known.stated),
    )


def _whole(triangle: _Triangle) -> Array:
    C = np.zeros((len(triangle), len(triangle)))
    for k, row in enumerate(triangle):
        C[k, : k + 1] = C[: k + 1, k] = row
    return C
