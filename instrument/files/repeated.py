"""The same measurement given twice: counted as two it would make everything look better known than it is."""

import hashlib
from collections.abc import Sequence
from pathlib import Path

from instrument.errors import BadInput


def refuse_repeats(paths: Sequence[Path]) -> None:
    """Raise `BadInput` where two files hold the same, to the last byte, or one is named twice.

    What cannot be read is said where it is read.
    """
    by_size: dict[int, list[Path]] = {}
    for path in paths:
        try:
            if path.is_file():
                by_size.setdefault(path.stat().st_size, []).append(path)
        except OSError:
            continue
    for alike in by_size.values():
        if len(alike) > 1:
            _refuse(alike)


def _refuse(paths: Sequence[Path]) -> None:
    seen: dict[str, Path] = {}
    for path in paths:
        try:
            with open(path, "rb") as file:
                digest = hashlib.file_digest(file, "sha256").hexdigest()
        except OSError:
            continue
        if digest in seen:
            raise BadInput(
                f"{path}: the same data as {seen[digest]}, to the last byte: expected a measurement once"
            )
        seen[digest] = path
