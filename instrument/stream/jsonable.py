"""Values as JSON knows them."""

import math
from typing import Any

import numpy as np


def plain(value: Any) -> Any:
    """Numbers, lists and objects that JSON knows; NaN and infinity become null."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
