"""Two pictures side by side."""

from dataclasses import fields, is_dataclass

import numpy as np


def facts(thing):
    """All a thing holds, down to numbers: to compare two of them."""
    if isinstance(thing, np.ndarray):
        return thing.dtype.str, thing.shape, thing.tobytes()
    if is_dataclass(thing) and not isinstance(thing, type):
        return type(thing).__name__, {f.name: facts(getattr(thing, f.name)) for f in fields(thing)}
    if isinstance(thing, dict):
        return {key: facts(value) for key, value in thing.items()}
    if isinstance(thing, list | tuple | set | frozenset):
        return [facts(one) for one in thing]
    return thing


SEEN = (
    *("contents", "run", "plan", "step", "acquisition", "range", "signal_level"),
    *("fits", "fit_running", "log", "changed", "time_s"),
)


def shown(state):
    """What pages can see of a picture."""
    return {name: facts(getattr(state, name)) for name in SEEN}
