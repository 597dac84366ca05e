"""What a row's outcome depends on, as one digest: contents, options and the program itself."""

import hashlib
import json
from functools import cache
from importlib.metadata import version
from pathlib import Path

import numpy as np
import scipy

from instrument.batch.task import BatchTask
from instrument.errors import BadInput
from instrument.files.text import refuse_endless

_ROOMS = ("fitting", "instrument")
_DIGITS = 32


class Keys:
    """Keys of tasks; a file that many of them name is read once."""

    def __init__(self) -> None:
        self._digest = cache(digest_of)

    def key(self, task: BatchTask) -> str | None:
        """None where a file cannot be read: such a row is tried again.

        A file's name counts, its folder does not: messages name files.
        """
        said: list[object] = [program(), task.diagnose, task.insist]
        for path in (task.data, task.specimen, task.hammer, task.like):
            try:
                said.append([Path(path).name, self._digest(path)] if path else None)
            except (BadInput, OSError):
                return None
        return hashlib.sha256(json.dumps(said).encode()).hexdigest()[:_DIGITS]

    def contents(self, task: BatchTask) -> str | None:
        """Digest of its data, whatever they are called; None where they cannot be read."""
        try:
            return self._digest(task.data)
        except (BadInput, OSError):
            return None


def digest_of(path: str) -> str:
    """SHA-256 of a file's content. Raises `BadInput`, `OSError`."""
    refuse_endless(Path(path))
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@cache
def program() -> str:
    """Version and sources of the program and of what it computes with."""
    digest = hashlib.sha256()
    root = Path(__file__).parents[2]
    for room in _ROOMS:
        for file in sorted((root / room).rglob("*.py")):
            digest.update(file.read_bytes())
    return f"{version('viscorig')} {digest.hexdigest()[:_DIGITS]} {np.__version__} {scipy.__version__}"
