"""Whose data a refusal is of, where what refuses them knows no files."""

from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import ParamSpec, TypeVar

from fitting.errors import FittingError

P = ParamSpec("P")
R = TypeVar("R")


def naming_data(command: Callable[P, R]) -> Callable[P, R]:
    """A command whose `data` are files: a refusal that names none of them begins with them.

    Raises what the command raises.
    """

    @wraps(command)
    def named(*args: P.args, **options: P.kwargs) -> R:
        try:
            return command(*args, **options)
        except FittingError as error:
            data = options.get("data")
            given = data if isinstance(data, tuple) else (data,)
            paths = [path for path in given if isinstance(path, Path)]
            if not paths or any(p.name in str(error) for p in paths):
                raise
            raise type(error)(f"{', '.join(map(str, paths))}: {error}") from None

    return named
