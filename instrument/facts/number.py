"""Numbers in results: JSON knows neither NaN nor infinity, it has null there."""

from math import isfinite, nan
from typing import Annotated

from pydantic import AfterValidator, BeforeValidator, PlainSerializer


def _nan_for_null(value: object) -> object:
    return nan if value is None or (isinstance(value, float) and not isfinite(value)) else value


def _none_for_nan(value: float | None) -> float | None:
    return value if value is not None and isfinite(value) else None


Number = Annotated[
    float, BeforeValidator(_nan_for_null), PlainSerializer(_none_for_nan, return_type=float | None)
]
"""NaN where there is none."""
MaybeNumber = Annotated[float | None, AfterValidator(_none_for_nan)]
"""None where there is none, or none was asked for."""
