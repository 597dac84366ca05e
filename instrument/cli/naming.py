"""Of which files a refusal is, where what refuses them knows none."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import wraps
from pathlib import Path
from typing import ParamSpec, TypeVar

from fitting.errors import FittingError
from instrument.errors import BadInput

P = ParamSpec("P")
R = TypeVar("R")


@contextmanager
def naming_records(paths: Sequence[Path]) -> Iterator[None]:
    """While open, a refusal of what files hold together has them first. Raises `BadInput`."""
    try:
        yield
    except BadInput as error:
        if any(p.name in str(error) for p in paths):
            raise
        more = f" and {len(paths) - 1} more" if len(paths) > 1 else ""
        raise BadInput(f"{paths[0]}{more}: {error}") from None


def naming_files(command: Callable[P, R]) -> Callable[P, R]:
    """A command whose `data`, or else whose `specimen`, are files: a refusal that names none has them first.

    Raises what the command raises.
    """

    @wraps(command)
    def named(*args: P.args, **options: P.kwargs) -> R:
        try:
            return command(*args, **options)
        except FittingError as error:
            read = options.get("data", options.get("specimen"))
            given = read if isinstance(read, tuple) else (read,)
            paths = [path for path in given if isinstance(path, Path)]
            if not paths or any(p.name in str(error) for p in paths):
                raise
            raise type(error)(f"{', '.join(map(str, paths))}: {error}") from None

    return named
