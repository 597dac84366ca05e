"""A file that is written whole or not at all."""

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from instrument.errors import BadInput, system_words

_LONGEST = 200
"""Letters of a name that its draft keeps: a file system takes 255 bytes."""


@contextmanager
def at_once(path: Path) -> Iterator[Path]:
    """A name to write to, which becomes `path` at the end and is no file where that fails. Raises `BadInput`.

    A disk that is full leaves what was there before. A device or a pipe is written to itself.
    """
    try:
        if path.exists() and not path.is_file():
            yield path
            return
        # Of a link, what it leads to is written.
        real = path.resolve()
        draft = real.with_name(f".{os.getpid()}.{real.name[-_LONGEST:]}")
        try:
            yield draft
            draft.replace(real)
        finally:
            with suppress(OSError):
                draft.unlink(missing_ok=True)
    except OSError as error:
        raise BadInput(f"{path}: {system_words(error)}") from None


def refuse_unwritable(path: Path) -> None:
    """Raise `BadInput` where a file or a folder of that name can be written by nobody of this user's rights.

    Said before the work that is to be written. Folders that are missing are passed over, a device too.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        return
    real = path.resolve()
    folder = next((p for p in (real, *real.parents) if p.is_dir()), None)
    if folder is not None and not os.access(folder, os.W_OK | os.X_OK):
        raise BadInput(f"{path}: {os.strerror(errno.EACCES)}: nothing can be written in {folder}")


def write_at_once(path: Path, text: str) -> None:
    """A text, in UTF-8. Raises `BadInput`."""
    with at_once(path) as draft:
        draft.write_text(text, encoding="utf-8")
