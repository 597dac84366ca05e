"""Arrays as they come from a notebook, made what the model may rely on."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from instrument.errors import BadInput


def numbers(
    name: str, values: ArrayLike, dtype: type, points: int | None = None, *, above_zero: bool = False
) -> NDArray[Any]:
    """A new array of finite numbers, shape (points,); a single number is repeated. Raises `BadInput`.

    `above_zero` asks that of real numbers, and of phasors that they are not zero.
    """
    try:
        given: NDArray[Any] = np.atleast_1d(np.asarray(values, dtype=dtype))
    except (TypeError, ValueError) as error:
        raise BadInput(f"{name}: {error}, expected numbers") from None
    if given.ndim != 1 or not given.size:
        raise BadInput(f"{name}: shape {given.shape}, expected one dimension with at least one point")
    if points is not None and given.size not in (1, points):
        raise BadInput(f"{name}: {given.size} numbers, expected {points}, one a frequency")
    _refuse(name, ~np.isfinite(given), given, "finite numbers")
    if above_zero:
        empty = given == 0 if np.iscomplexobj(given) else given <= 0
        _refuse(name, empty, given, "a phasor that is not zero" if np.iscomplexobj(given) else "more than 0")
    return np.array(np.broadcast_to(given, given.size if points is None else points))


def _refuse(name: str, bad: NDArray[np.bool_], values: NDArray[Any], expected: str) -> None:
    if bad.any():
        k = int(np.argmax(bad))
        raise BadInput(f"{name}[{k}] = {values[k]:g}, expected {expected}")
