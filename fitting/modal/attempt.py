"""A fit that breaks down is a result: a refusal that says why."""

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

import numpy as np

from fitting.modal.frf import Refusal

P = ParamSpec("P")
R = TypeVar("R")

_LONGEST = 80
"""Characters of what a library says; a choice: one line on a screen."""


def refusing(fit: Callable[P, R]) -> Callable[P, R | Refusal]:
    """Make a fit refuse where its numbers are beyond what can be computed with."""

    @wraps(fit)
    def attempt(*args: P.args, **kwargs: P.kwargs) -> R | Refusal:
        try:
            with np.errstate(all="ignore"):
                return fit(*args, **kwargs)
        except (ArithmeticError, ValueError) as error:
            # numpy's LinAlgError is a ValueError.
            return Refusal(f"the fit broke down: {' '.join(str(error).split())[:_LONGEST]}")

    return attempt
