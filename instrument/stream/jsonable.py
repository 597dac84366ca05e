"""Values as JSON knows them."""

import math
from typing import Any

import numpy as np


def to_jsonable(value: Any) -> Any:
    """Numbers, lists and objects that JSON knows; NaN and infinity become null."""
    if isinstance(value, dict):
        return {str(key): to_jsonable(item) for key, item in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [to_jsonable(item) for item in value]
    if isinstance(value, np.generic):
        return to_jsonable(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
